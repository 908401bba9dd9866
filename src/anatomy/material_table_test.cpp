// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/material_table.hpp"

#include <gtest/gtest.h>

namespace carpus::anatomy {
namespace {

TEST(MaterialTable, EveryTissueHasSixFieldsWithinTheirRanges) {
  ASSERT_EQ(materials().size(), 5U);
  for (const Material& m : materials()) {
    EXPECT_EQ(&material_of(m.tissue), &m);
    for (const auto& colour : {m.diffuse, m.emissive, m.specular}) {
      for (const double c : colour) {
        EXPECT_GE(c, 0) << m.name;
        EXPECT_LE(c, 1) << m.name;
      }
    }
    for (const double field : {m.ambient, m.shininess, m.transparency}) {
      EXPECT_GE(field, 0) << m.name;
      EXPECT_LE(field, 1) << m.name;
    }
  }
}

TEST(MaterialTable, ShininessBecomesRoughness) {
  Material m;
  m.shininess = 0;  // the widest spot that Blinn and Phong's law has
  EXPECT_DOUBLE_EQ(roughness_of(m), 1);
  m.shininess = 1;
  EXPECT_NEAR(roughness_of(m), 0.352, 1e-3);  // (2 / 130)^(1/4)
  EXPECT_NEAR(roughness_of(material_of(Tissue::Bone)), 0.72, 1e-3);
}

}  // namespace
}  // namespace carpus::anatomy

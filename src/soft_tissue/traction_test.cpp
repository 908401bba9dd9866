// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/traction.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "fields/distance_field.hpp"
#include "soft_tissue/make_soft_tissue.hpp"
#include "soft_tissue/model_case_test_support.hpp"

namespace carpus::soft_tissue {
namespace {

// One test: the tissue takes seconds to make.
TEST(Traction, OpensJointsAsFarAsLigamentsLet) {
  cases::CaseData data = test::model_case(Side::Left, 1, Mat3::identity());
  for (cases::Bone& b : data.bones) b.distance_field = fields::build_distance_field(b.surface);
  TissueTable table = TissueTable::generic();
  table.spaces.clear();
  const SoftTissue tissue = make_soft_tissue(data, table);
  const auto pulled = [&](TractionOptions o) {
    const TractionResult r = pull(data, tissue, o);
    std::printf("%.0f N x %.0f, slack %.2f / %.2f: %.3f / %.3f mm, left %.3f N\n", o.force_n,
                o.stiffness_factor, o.radiocarpal_slack_mm, o.midcarpal_slack_mm, r.radiocarpal_mm,
                r.midcarpal_mm, r.unbalanced_n);
    EXPECT_LT(r.unbalanced_n, 0.5);
    return r;
  };
  TractionOptions options;
  options.force_n = 0;
  const TractionResult rest = pulled(options);
  EXPECT_NEAR(rest.radiocarpal_mm, 0, 0.02);
  EXPECT_NEAR(rest.midcarpal_mm, 0, 0.02);
  options.force_n = 98;
  const TractionResult soft = pulled(options);
  EXPECT_GT(soft.radiocarpal_mm, 0.2);
  EXPECT_GT(soft.midcarpal_mm, 0.2);
  options.stiffness_factor = 3;
  const TractionResult stiff = pulled(options);
  EXPECT_LT(stiff.radiocarpal_mm, soft.radiocarpal_mm);
  EXPECT_LT(stiff.midcarpal_mm, soft.midcarpal_mm);
  // Published: 1.0 and 2.0 mm [S66]; slack is fitted to it within 0.2.
  options = fit_slack(data, tissue, options, 1.0, 2.0);
  const TractionResult fitted = pulled(options);
  EXPECT_NEAR(fitted.radiocarpal_mm, 1.0, 0.2);
  EXPECT_NEAR(fitted.midcarpal_mm, 2.0, 0.2);
}

}  // namespace
}  // namespace carpus::soft_tissue

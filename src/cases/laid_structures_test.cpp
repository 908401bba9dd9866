// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/laid_structures.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/rng.hpp"
#include "geometry/segment_distance.hpp"

namespace carpus::cases {
namespace {

TEST(LaidStructures, GapsAreThoseOfEveryPieceOfTheTube) {
  CaseData data;
  data.bones.resize(3);
  data.bones[0].bone = BoneId::Radius;
  data.bones[1].bone = BoneId::Ulna;
  data.bones[2].bone = BoneId::Capitate;
  Rng rng(5);
  const auto anywhere = [&](double within) {
    return Vec3{rng.normal(), rng.normal(), rng.normal()} * within;
  };
  Structure tube{"tube", "a tendon", anatomy::StructureKind::Tendon, 1.1, BoneId::Radius, {}};
  Vec3 at = anywhere(10);
  for (int i = 0; i < 60; ++i) tube.course.push_back({at += anywhere(1.5), 0.0});
  data.structures = {tube};
  LaidStructures watch(data);
  const std::vector<Pose<frame::Patient, frame::Bone>> still(data.bones.size());
  watch.follow(still);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 from = anywhere(20);
    const Vec3 to = from + anywhere(20);
    double least = 1e9;
    for (std::size_t i = 1; i < tube.course.size(); ++i) {
      least = std::min(least, segment_distance(from, to, tube.course[i - 1].at, tube.course[i].at));
    }
    EXPECT_NEAR(watch.gap_mm(0, from, to), least - 1.1, 1e-9);
    EXPECT_NEAR(watch.gap_mm(0, from, to, 4.0), std::min(4.0, least - 1.1), 1e-9);
  }
}

}  // namespace
}  // namespace carpus::cases

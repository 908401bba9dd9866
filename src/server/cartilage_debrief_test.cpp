// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/cartilage_debrief.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "simulation/operation_test_support.hpp"

namespace carpus::server {
namespace {

/// Two facets of the first bone, one of the second, outside all bone; one look sees the first's
/// first.
cases::CaseData with_cartilage(const Vec3& eye) {
  cases::CaseData data = simulation::test::wrist();
  auto map = std::make_shared<cases::ArthroscopicMap>();
  map->joints.resize(2);
  map->cartilage = {{eye + Vec3{0, 0, 5}, {0, 0, -1}, 1.0, 0, 0},
                    {eye + Vec3{0, 0, -5}, {0, 0, 1}, 3.0, 0, 0},
                    {eye + Vec3{0, 1, 5}, {0, 0, -1}, 4.0, 1, 1}};
  data.arthroscopy = map;
  return data;
}

TEST(CartilageDebrief, TellsFacetByFacetOfEachBoneWhatTheLooksShowed) {
  const Vec3 eye{500, 500, 500};
  const cases::CaseData data = with_cartilage(eye);
  procedure::ScopeRecord scope;
  scope.least_cosine = 0.8;
  procedure::ScopeLook look;
  look.eye = eye;
  look.axis = {0, 0, 1};
  scope.looks = {look};
  const protocol::SeenCartilage seen = seen_cartilage(data, scope);
  ASSERT_EQ(seen.bones.size(), 2U);
  EXPECT_EQ(seen.bones[0].seen, (std::vector<std::int64_t>{1, 0})) << "the other lies behind it";
  EXPECT_EQ(seen.bones[1].seen, (std::vector<std::int64_t>{0})) << "of another joint";
  EXPECT_DOUBLE_EQ(seen.bones[0].seen_share, 25.0);
  EXPECT_DOUBLE_EQ(seen.bones[1].seen_share, 0.0);
  EXPECT_DOUBLE_EQ(seen.share, 12.5);
  EXPECT_NE(seen.bones[0].bone, seen.bones[1].bone);
}

}  // namespace
}  // namespace carpus::server

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/force_lines.hpp"

#include <gtest/gtest.h>

namespace carpus::soft_tissue::detail {
namespace {

cases::CaseData three_bones() {
  cases::CaseData data;
  for (const BoneId bone : {BoneId::Radius, BoneId::Scaphoid, BoneId::Capitate}) {
    cases::Bone b;
    b.bone = bone;
    b.label = static_cast<std::uint8_t>(bone);
    data.bones.push_back(std::move(b));
  }
  return data;
}

/// From the radius over the scaphoid, 4 mm, to the capitate, 12 mm on.
SoftTissue one_ligament(const char* id, const char* group) {
  Ligament l;
  l.id = id;
  l.group = group;
  Strand s;
  s.course = {{0, 0, 0}, {4, 0, 0}, {16, 0, 0}};
  std::size_t point = 0;
  for (const BoneId bone : {BoneId::Radius, BoneId::Scaphoid, BoneId::Capitate}) {
    Anchor a;
    a.label = static_cast<std::uint8_t>(bone);
    a.point = point++;
    s.anchors.push_back(a);
  }
  s.stiffness_n_per_mm = 10;
  l.strands.push_back(s);
  SoftTissue tissue;
  tissue.ligaments.push_back(l);
  return tissue;
}

TEST(ForceLines, HeldOnItsWayAStrandIsTwoThatTogetherAreAsStiff) {
  const auto data = three_bones();
  const SoftTissue tissue = one_ligament("RSC", "radiocarpal");
  LineOptions options;
  options.stiffness_factor = 2;
  options.radiocarpal_slack_mm = 1.6;
  const auto slides = make_force_lines(data, tissue, options);
  ASSERT_EQ(slides.size(), 1u);
  EXPECT_NEAR(slides[0].rest_mm, 17.6, 1e-12);
  options.is_held_on_its_way = true;
  const auto held = make_force_lines(data, tissue, options);
  ASSERT_EQ(held.size(), 2u);
  EXPECT_NEAR(held[0].rest_mm, 4.4, 1e-12);
  EXPECT_NEAR(held[1].rest_mm, 13.2, 1e-12);
  EXPECT_NEAR(held[0].stiffness_n_per_mm, 80, 1e-9);
  EXPECT_NEAR(1 / held[0].stiffness_n_per_mm + 1 / held[1].stiffness_n_per_mm,
              1 / slides[0].stiffness_n_per_mm, 1e-12);
}

TEST(ForceLines, PullOnlyWhatIsStretchedAndNotCut) {
  const auto data = three_bones();
  const SoftTissue tissue = one_ligament("SL_volar", "proximal_row");
  const auto lines = make_force_lines(data, tissue, {});
  Bodies bodies = bodies_as_scanned(data);
  Load slack;
  pull_lines(lines, bodies, slack);
  EXPECT_EQ(slack.energy, 0);
  bodies[kHand].shift = {0.5, 0, 0};
  Load pulled;
  pull_lines(lines, bodies, pulled);
  EXPECT_NEAR(pulled.energy, 0.5 * 10 * 0.25, 1e-12);
  EXPECT_NEAR(pulled.force[kHand].x, -5, 1e-12);
  // Sliding, it pulls the bone on its way from both sides alike.
  EXPECT_NEAR(length(pulled.force[kScaphoid]), 0, 1e-12);
  const std::array<std::string_view, 2> cuts{"DIC", "SL_"};
  LineOptions options;
  options.without = cuts;
  EXPECT_TRUE(make_force_lines(data, tissue, options).empty());
}

}  // namespace
}  // namespace carpus::soft_tissue::detail

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/bone_id.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "anatomy/bone_words.hpp"

namespace carpus {
namespace {

TEST(BoneId, EveryNameLeadsBackToItsBone) {
  for (const BoneId bone : kAllBones) {
    EXPECT_EQ(bone_of(name_of(bone)), (NamedBone{bone, BonePart::Whole}));
  }
  EXPECT_EQ(bone_of("scaphoid_distal"), (NamedBone{BoneId::Scaphoid, BonePart::Distal}));
  EXPECT_EQ(bone_of("scaphoid_proximal"), (NamedBone{BoneId::Scaphoid, BonePart::Proximal}));
  EXPECT_EQ(bone_of("navicular"), std::nullopt);
  EXPECT_EQ(side_of(name_of(Side::Right)), Side::Right);
  EXPECT_EQ(side_of("middle"), std::nullopt);
}

TEST(BoneWords, HoldNoIdentifierAndNoTwoAreAlike) {
  std::set<std::string_view> all{words_of(BoneId::Scaphoid, BonePart::Proximal),
                                 words_of(BoneId::Scaphoid, BonePart::Distal)};
  for (const BoneId bone : kAllBones) all.insert(words_of(bone));
  EXPECT_EQ(all.size(), kAllBones.size() + 2);
  for (const std::string_view words : all) {
    EXPECT_EQ(words.find_first_of("_0123456789"), std::string_view::npos) << words;
  }
  EXPECT_EQ(words_of(BoneId::Metacarpal3), "third metacarpal");
}

}  // namespace
}  // namespace carpus

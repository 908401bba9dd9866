// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/make_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "arthroscopy/disc_net.hpp"
#include "arthroscopy/generic_wrist_test_support.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

using cases::TissueKind;
using cases::TissuePiece;

constexpr std::array<std::uint8_t, 5> kPlaces{11, 12, 15, 16, 17};
constexpr double kFrayedMm = 0.8;
constexpr double kRimMm = 2.0;

cases::JointLesions inflamed(std::uint64_t seed, std::span<const std::uint8_t> places = kPlaces) {
  const test::GenericWrist& wrist = test::generic_wrist();
  return make_synovitis(wrist.data, wrist.map, {{2, 3}, {10, 16}, places}, seed);
}

cases::JointLesions torn(const std::string& grade, std::uint64_t seed = 1) {
  const test::GenericWrist& wrist = test::generic_wrist();
  return make_torn_disc(wrist.data, wrist.map, {{&grade, 1}, kFrayedMm, kRimMm}, seed);
}

bool is_same(const TissuePiece& a, const TissuePiece& b) {
  return a.at == b.at && a.inwards == b.inwards && a.height_mm == b.height_mm &&
         a.radius_mm == b.radius_mm && a.patch == b.patch && a.is_ill == b.is_ill &&
         a.is_rim == b.is_rim && a.is_gone == b.is_gone;
}

bool are_same(const cases::JointLesions& a, const cases::JointLesions& b) {
  return std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(), is_same);
}

TEST(MakeSynovitis, SoManyTuftsInSoManyPatchesApartOnTheWall) {
  const cases::ArthroscopicMap& map = test::generic_wrist().map;
  std::set<std::size_t> patches;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const cases::JointLesions made = inflamed(seed);
    std::map<int, std::size_t> tufts;
    for (const TissuePiece& tuft : made.pieces) {
      ++tufts[tuft.patch];
      EXPECT_EQ(tuft.kind, TissueKind::Synovium);
      EXPECT_TRUE(tuft.is_ill && !tuft.is_rim && !tuft.is_gone);
      const auto wall = fields::sample_distance(map.joints[tuft.joint].wall, tuft.at);
      EXPECT_LT(std::abs(wall.distance_mm), 0.3) << seed << ": it stands on the wall";
      const auto at = [&](double mm) {
        const Vec3 off = tuft.at + tuft.inwards * mm;
        return fields::sample_distance(map.joints[tuft.joint].wall, off).distance_mm;
      };
      EXPECT_LT(at(0.3), at(-0.3)) << seed << ": into the joint";
      EXPECT_NEAR(length(tuft.inwards), 1, 1e-9);
      EXPECT_GE(tuft.height_mm, 0.7);
      EXPECT_LE(tuft.height_mm, 1.5);
      for (const TissuePiece& other : made.pieces) {
        if (&other == &tuft || other.patch != tuft.patch) continue;
        EXPECT_GE(distance(other.at, tuft.at), 0.5) << seed;
      }
    }
    patches.insert(tufts.size());
    EXPECT_LE(made.pieces.size(), cases::kMaxPieces);
    for (const auto& [patch, count] : tufts) {
      EXPECT_LE(count, 16U);
      EXPECT_GE(count, 10U) << "seed " << seed << ", patch " << patch;
    }
  }
  EXPECT_EQ(patches, (std::set<std::size_t>{2, 3}));
}

TEST(MakeSynovitis, TheSameSeedGivesTheSameAndAnotherOneAnother) {
  EXPECT_TRUE(are_same(inflamed(5), inflamed(5)));
  EXPECT_FALSE(are_same(inflamed(5), inflamed(6)));
}

TEST(MakeSynovitis, WhereTheCaseLacksThePlacesThereAreFewer) {
  constexpr std::array<std::uint8_t, 2> kElsewhere{30, 31};
  EXPECT_TRUE(inflamed(1, kElsewhere).pieces.empty());
  constexpr std::array<std::uint8_t, 3> kOneOfThem{30, 16, 31};
  const cases::JointLesions made = inflamed(1, kOneOfThem);
  EXPECT_FALSE(made.pieces.empty());
  for (const TissuePiece& tuft : made.pieces) EXPECT_EQ(tuft.patch, 0);
}

TEST(MakeTornDisc, APieceForEachParticleOfTheSheetInItsOrder) {
  const cases::ArthroscopicMap& map = test::generic_wrist().map;
  for (const char* grade : {"1A", "2C"}) {
    const cases::JointLesions made = torn(grade);
    const yielding::Net net = disc_net(map, &made);
    ASSERT_GT(net.size(), 0U);
    ASSERT_LE(net.size(), cases::kMaxPieces);
    ASSERT_EQ(made.pieces.size(), net.size());
    for (std::size_t i = 0; i < net.size(); ++i) {
      EXPECT_EQ(made.pieces[i].kind, TissueKind::Disc);
      EXPECT_EQ(made.pieces[i].body, map.forearm);
      EXPECT_NEAR(distance(made.pieces[i].at, net.rest()[i]), kHalfDiscMm, 1e-9);
    }
  }
}

TEST(MakeTornDisc, LooseNearTheTearGoneOnlyWhereItIsWornThroughAndTheRimIsSound) {
  const cases::ArthroscopicMap& map = test::generic_wrist().map;
  for (const char* grade : {"1A", "2C"}) {
    const cases::JointLesions made = torn(grade);
    ASSERT_EQ(made.lesions.size(), 1U) << grade;
    const cases::Lesion& tear = made.lesions.front();
    const yielding::Net net = disc_net(map, &made);
    int gone = 0;
    int ill = 0;
    int rim = 0;
    int sound = 0;
    const Vec3 along = tear.to - tear.from;
    for (std::size_t i = 0; i < net.size(); ++i) {
      const TissuePiece& piece = made.pieces[i];
      const double share =
          std::clamp(dot(piece.at - tear.from, along) / squared_length(along), 0.0, 1.0);
      const double off = distance(piece.at, tear.from + along * share);
      EXPECT_EQ(piece.is_ill || piece.is_gone, off < tear.radius_mm + kFrayedMm) << grade << i;
      EXPECT_LE(piece.is_ill + piece.is_rim + piece.is_gone, 1) << "one of them";
      if (piece.is_rim) {
        double nearest = 1e9;
        for (std::size_t k = 0; k < net.size(); ++k) {
          if (net.is_held(k)) nearest = std::min(nearest, distance(net.rest()[k], net.rest()[i]));
        }
        EXPECT_LT(nearest, kRimMm);
      }
      gone += piece.is_gone;
      ill += piece.is_ill;
      rim += piece.is_rim;
      sound += !piece.is_gone && !piece.is_ill;
    }
    EXPECT_EQ(gone > 0, grade == std::string("2C")) << grade << ": a slit has no room of its own";
    EXPECT_GT(ill, 3) << grade;
    EXPECT_GT(rim, 10) << grade;
    EXPECT_GT(sound, rim) << grade << ": not all of what is sound is rim";
  }
}

TEST(MakeTornDisc, OneOfTheTearsByTheSeedAndTheSameSeedTheSame) {
  const test::GenericWrist& wrist = test::generic_wrist();
  const std::array<std::string, 2> tears{"1A", "2C"};
  std::set<cases::LesionLook> looks;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const TornDiscChoice choice{tears, kFrayedMm, kRimMm};
    const cases::JointLesions one = make_torn_disc(wrist.data, wrist.map, choice, seed);
    EXPECT_TRUE(are_same(one, make_torn_disc(wrist.data, wrist.map, choice, seed)));
    ASSERT_FALSE(one.lesions.empty());
    looks.insert(one.lesions.front().look);
  }
  EXPECT_EQ(looks, (std::set<cases::LesionLook>{cases::LesionLook::Tear, cases::LesionLook::Worn}));
}

TEST(MakeTornDisc, WithoutADiscThereIsNothingToTrim) {
  const test::GenericWrist& wrist = test::generic_wrist();
  cases::ArthroscopicMap map = wrist.map;
  map.disc_sheet = {};
  const std::string tear = "1A";
  EXPECT_TRUE(make_torn_disc(wrist.data, map, {{&tear, 1}, 0.8, 2}, 1).pieces.empty());
}

}  // namespace
}  // namespace carpus::arthroscopy

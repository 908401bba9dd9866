// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/make_lesions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "arthroscopy/band_table.hpp"
#include "arthroscopy/detail/scanned_bones.hpp"
#include "arthroscopy/generic_wrist_test_support.hpp"
#include "cases/joint_under_block.hpp"
#include "core/error.hpp"

namespace carpus::arthroscopy {
namespace {

using cases::Grades;
using cases::JointLesions;
using cases::Lesion;

constexpr double kProbeMm = 0.5;  // radii of the catalogue
constexpr double kThickScopeMm = 1.35;

const PathologyTable& table() { return PathologyTable::generic(); }

std::size_t finding(const std::string& id) {
  for (std::size_t f = 0; f < table().findings.size(); ++f) {
    if (table().findings[f].id == id) return f;
  }
  ADD_FAILURE() << "nothing is asked of " << id;
  return 0;
}

JointLesions with(const std::string& id, std::uint8_t grade) {
  Grades grades{};
  grades[finding(id)] = grade;
  const test::GenericWrist& wrist = test::generic_wrist();
  return make_lesions(wrist.data, wrist.map, table(), grades, 1);
}

std::size_t body_of(BoneId id) {
  const auto& bones = test::generic_wrist().data.bones;
  return static_cast<std::size_t>(
      std::find_if(bones.begin(), bones.end(), [&](const auto& b) { return b.bone == id; }) -
      bones.begin());
}

/// Whether a tip of that radius goes through any of them, in its middle.
bool lets_through(const JointLesions& made, double radius_mm) {
  return std::any_of(made.lesions.begin(), made.lesions.end(), [&](const Lesion& lesion) {
    return cases::passes(lesion, (lesion.from + lesion.to) * 0.5, radius_mm);
  });
}

TEST(GradesBy, TheSameSeedIsTheSameWristAndAnotherIsAnother) {
  EXPECT_EQ(grades_by(7, table()), grades_by(7, table()));
  int same = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    same += grades_by(seed, table()) == grades_by(seed + 1, table()) ? 1 : 0;
  }
  EXPECT_LT(same, 10) << "two healthy ones in a row are the same";
}

TEST(GradesBy, ForRecordingsWithoutGradesOnlyThoseOfThatTimeAreDrawn) {
  int others = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Grades all = grades_by(seed, table());
    const Grades old = grades_by(seed, table(), Drawn::WithoutGrades);
    for (std::size_t f = 0; f < table().findings.size(); ++f) {
      EXPECT_LE(old[f], table().scale_of(f).drawn());
      EXPECT_EQ(all[f] == 0, old[f] == 0) << "what is wrong is the same";
      others += all[f] > table().scale_of(f).drawn() ? 1 : 0;
    }
  }
  EXPECT_GT(others, 20);
}

TEST(GradesBy, HealthyWristsAndEveryGradeOccurAsOftenAsTheTableSays) {
  constexpr int kSeeds = 4000;
  int healthy = 0;
  std::array<std::array<int, 16>, cases::kMaxFindings> count{};
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Grades grades = grades_by(seed, table());
    healthy += grades == Grades{} ? 1 : 0;
    for (std::size_t f = 0; f < table().findings.size(); ++f) {
      ++count.at(f).at(grades[f]);
    }
  }
  EXPECT_NEAR(healthy, table().healthy_share * kSeeds, 0.02 * kSeeds);
  for (std::size_t f = 0; f < table().findings.size(); ++f) {
    const auto grades = table().scale_of(f).grades.size();
    const double wrong = kSeeds - count[f][0];
    const double expected = (1 - table().healthy_share) * table().findings[f].chance;
    // The first stands in where nothing else is wrong.
    EXPECT_NEAR(wrong / kSeeds, expected, f == 0 ? 0.05 : 0.025) << table().findings[f].id;
    for (std::size_t g = 1; g < grades; ++g) {
      EXPECT_NEAR(count[f][g], wrong / static_cast<double>(grades - 1), 0.25 * wrong)
          << table().findings[f].id << " " << g;
    }
  }
}

/// [K, B9]: a probe passes from III on, the 2.7 mm scope at IV.
TEST(MakeLesions, WhatGoesThroughATornLigamentTellsItsGrade) {
  for (const char* id : {"scapholunate", "lunotriquetral"}) {
    EXPECT_FALSE(lets_through(with(id, 1), kProbeMm)) << id;
    EXPECT_FALSE(lets_through(with(id, 2), kProbeMm)) << id;
    EXPECT_TRUE(lets_through(with(id, 3), kProbeMm)) << id;
    EXPECT_FALSE(lets_through(with(id, 3), kThickScopeMm)) << id;
    EXPECT_TRUE(lets_through(with(id, 4), kThickScopeMm)) << id;
  }
}

TEST(MakeLesions, WhatHasAStepShowsInBothJointsABruisedLigamentInTheRadiocarpalAlone) {
  const auto joints = [](const JointLesions& made) {
    std::vector<std::string> ids;
    for (const Lesion& lesion : made.lesions) {
      ids.push_back(test::generic_wrist().map.joints[lesion.joint].id);
    }
    return ids;
  };
  EXPECT_EQ(joints(with("scapholunate", 1)), std::vector<std::string>{"radiocarpal"});
  for (std::uint8_t grade = 2; grade <= 4; ++grade) {
    const JointLesions made = with("scapholunate", grade);
    ASSERT_EQ(joints(made), (std::vector<std::string>{"radiocarpal", "midcarpal"}));
    EXPECT_EQ(made.lesions[1].look, cases::LesionLook::Tear);
    EXPECT_EQ(made.lesions[0].look == cases::LesionLook::Stain, grade == 2);
  }
}

/// Of the interval's face between two places of the tour, by the fields alone.
Vec3 across_interval(BoneId moves, BoneId stays, const char* from, const char* to) {
  const test::GenericWrist& wrist = test::generic_wrist();
  const auto place = [&](const std::string& id) {
    return std::find_if(wrist.map.points.begin(), wrist.map.points.end(),
                        [&](const auto& point) { return point.id == id; })
        ->at;
  };
  Vec3 sum;
  for (int i = 0; i <= 16; ++i) {
    const Vec3 at = place(from) + (place(to) - place(from)) * (i / 16.0);
    const auto a = fields::sample_distance(wrist.data.bones[body_of(stays)].distance_field, at);
    const auto b = fields::sample_distance(wrist.data.bones[body_of(moves)].distance_field, at);
    const bool is_near = a.distance_mm + b.distance_mm < BandTable::generic().cartilage_mm;
    if (is_near) sum += normalized_or(a.gradient - b.gradient, {});
  }
  return normalized_or(sum, {});
}

/// Level and closed at I; from II on bones stand apart, and only while they are pulled.
TEST(MakeLesions, BonesPartByGapAndStepUnderTraction) {
  const std::size_t scaphoid = body_of(BoneId::Scaphoid);
  const std::size_t lunate = body_of(BoneId::Lunate);
  for (std::uint8_t grade = 1; grade <= 4; ++grade) {
    const JointLesions made = with("scapholunate", grade);
    const Grade& how = table().scale_of(finding("scapholunate")).grades[grade];
    const auto apart = [&](double pull) {
      return made.shift_of(scaphoid, pull) - made.shift_of(lunate, pull);
    };
    const Vec3 full = apart(69);
    const Vec3 across = across_interval(BoneId::Scaphoid, BoneId::Lunate, "sl_gap", "sl_ligament");
    const Vec3& distal = test::generic_wrist().map.distal;
    const Vec3 along = normalized_or(distal - across * dot(distal, across), {});
    EXPECT_NEAR(dot(full, across), how.gap_mm, 1e-9);
    EXPECT_NEAR(dot(full, along), how.step_mm, 1e-9);
    EXPECT_NEAR(length(full), std::hypot(how.gap_mm, how.step_mm), 1e-9);
    EXPECT_EQ(apart(0), (Vec3{0, 0, 0}));
    EXPECT_NEAR(length(apart(17)), length(full) / 2, 1e-9);
  }
}

TEST(MakeLesions, EachFindingShowsOnTheWallOfItsJoint) {
  const test::GenericWrist& wrist = test::generic_wrist();
  for (std::size_t f = 0; f < table().findings.size(); ++f) {
    const std::string& id = table().findings[f].id;
    for (std::uint8_t g = 1; g < table().scale_of(f).grades.size(); ++g) {
      const JointLesions made = with(id, g);
      ASSERT_FALSE(made.lesions.empty()) << id << " " << int{g};
      EXPECT_EQ(made.grades[f], g);
      const auto& brings = table().scale_of(f).grades[g].with;
      for (const Lesion& lesion : made.lesions) {
        EXPECT_TRUE(lesion.finding == f || (brings && lesion.finding == brings->finding));
        EXPECT_NEAR(length(lesion.outwards), 1, 1e-9);
        const double off = lesion.look == cases::LesionLook::Loose ? lesion.radius_mm + 0.3 : 0.3;
        for (const Vec3& end : {lesion.from, lesion.to}) {
          const auto at = fields::sample_distance(wrist.map.joints[lesion.joint].wall, end);
          EXPECT_NEAR(at.distance_mm, 0, off) << id << " " << int{g};
        }
      }
    }
  }
}

/// Joints are narrow as scanned: moved aside by the seed a patch could lie on the bone across.
TEST(MakeLesions, APatchOfCartilageLiesOnItsOwnSideWhateverTheSeed) {
  const test::GenericWrist& wrist = test::generic_wrist();
  const auto is_forearm = [&](std::size_t body) {
    return belongs_to_forearm(wrist.data.bones[body].bone);
  };
  for (const char* id :
       {"cartilage_scaphoid_fossa", "cartilage_lunate_fossa", "cartilage_scaphoid"}) {
    Grades grades{};
    grades[finding(id)] = 3;
    int across = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const JointLesions made = make_lesions(wrist.data, wrist.map, table(), grades, seed);
      ASSERT_EQ(made.lesions.size(), 1U);
      const Lesion& patch = made.lesions[0];
      if (is_forearm(detail::nearest_body(wrist.data, patch.from)) != is_forearm(patch.body)) {
        ++across;
      }
    }
    EXPECT_EQ(across, 0) << id;
  }
}

/// Pulled as for an examination, and where the pull is least no deeper than their cartilage is
/// thick together [K, B11]: 0.68 mm at Geissler IV and 34 N, nothing at 69 N.
TEST(MakeLesions, BonesThatStandApartPassIntoEachOthersCartilageAtMost) {
  const test::GenericWrist& wrist = test::generic_wrist();
  for (const char* id : {"scapholunate", "lunotriquetral"}) {
    const JointLesions made = with(id, 4);
    for (const double pull : {34.0, 69.0}) {
      anatomy::HandPose pose = wrist.data.hand_motion.scan;
      pose.traction_n = pull;
      std::vector<Pose<frame::Patient, frame::Bone>> poses;
      for (std::size_t b = 0; b < wrist.data.bones.size(); ++b) {
        poses.push_back(
            cases::pose_under_block(wrist.data.hand_motion, wrist.data.bones[b].bone, pose));
        poses.back().translation += made.shift_of(b, pull);
      }
      double deepest = 0;
      for (std::size_t a = 0; a < poses.size(); ++a) {
        for (std::size_t b = 0; b < poses.size(); ++b) {
          if (a == b) continue;
          const auto b_from_a = poses[b].inverse() * poses[a];
          for (const Vec3& v : wrist.data.bones[a].surface.vertices) {
            const auto s = fields::sample_distance(wrist.data.bones[b].distance_field,
                                                   (b_from_a * Point<frame::Bone>{v}).v);
            if (s.is_inside_grid) deepest = std::min(deepest, s.distance_mm);
          }
        }
      }
      EXPECT_GT(deepest, pull < 69.0 ? -0.8 : -0.05) << id << " at " << pull << " N";
    }
  }
}

TEST(MakeLesions, WhatTheCaseHasNoPlaceForIsWell) {
  const test::GenericWrist& wrist = test::generic_wrist();
  cases::ArthroscopicMap less = wrist.map;
  std::erase_if(less.points, [](const auto& point) { return point.id == "sl_gap"; });
  Grades grades{};
  grades[finding("scapholunate")] = 3;
  grades[finding("disc")] = 1;
  const JointLesions made = make_lesions(wrist.data, less, table(), grades, 1);
  EXPECT_EQ(made.grades[finding("scapholunate")], 0);
  EXPECT_EQ(made.grades[finding("disc")], 1);
}

std::uint8_t palmer(const std::string& id) {
  const auto& grades = table().scale_of(finding("disc")).grades;
  const auto at =
      std::find_if(grades.begin(), grades.end(), [&](const Grade& each) { return each.id == id; });
  return static_cast<std::uint8_t>(at - grades.begin());
}

/// [K, B9]: worn, with the lunate's cartilage too, through, with the lunotriquetral ligament,
/// arthritis.
TEST(MakeLesions, PalmersSecondClassIsOfSeveralPlacesTogether) {
  const std::size_t disc = finding("disc");
  const std::size_t torn = finding("lunotriquetral");
  const std::size_t lunate = body_of(BoneId::Lunate);
  const auto on_lunate = [&](const JointLesions& made) {
    return std::count_if(made.lesions.begin(), made.lesions.end(), [&](const Lesion& lesion) {
      return lesion.finding == disc && lesion.body == lunate;
    });
  };
  const auto is_holed = [&](const JointLesions& made) {
    return std::any_of(made.lesions.begin(), made.lesions.end(), [&](const Lesion& lesion) {
      return lesion.finding == disc && lesion.passes_mm > 0;
    });
  };
  struct Expected {
    const char* id;
    int on_lunate;
    bool is_holed;
    int torn;
  };
  for (const Expected& e :
       {Expected{"2A", 0, false, 0}, Expected{"2B", 1, false, 0}, Expected{"2C", 0, true, 0},
        Expected{"2D", 0, true, 3}, Expected{"2E", 1, true, 3}}) {
    const JointLesions made = with("disc", palmer(e.id));
    EXPECT_EQ(made.grades[disc], palmer(e.id)) << e.id;
    EXPECT_EQ(on_lunate(made), e.on_lunate) << e.id;
    EXPECT_EQ(is_holed(made), e.is_holed) << e.id;
    EXPECT_EQ(made.grades[torn], e.torn) << e.id;
    EXPECT_EQ(made.shift_of(lunate, 69) != Vec3{}, e.torn > 0) << e.id;
  }
}

TEST(MakeLesions, AHoleInTheDiscBesideATornLunotriquetralLigamentIsToldAsBoth) {
  const test::GenericWrist& wrist = test::generic_wrist();
  Grades grades{};
  grades[finding("disc")] = palmer("2C");
  const auto disc_with = [&](std::uint8_t torn, const cases::ArthroscopicMap& map) {
    grades[finding("lunotriquetral")] = torn;
    return make_lesions(wrist.data, map, table(), grades, 1).grades[finding("disc")];
  };
  EXPECT_EQ(disc_with(2, wrist.map), palmer("2C")) << "attenuated is not torn";
  EXPECT_EQ(disc_with(3, wrist.map), palmer("2D"));
  EXPECT_EQ(disc_with(4, wrist.map), palmer("2D"));
  cases::ArthroscopicMap less = wrist.map;
  std::erase_if(less.points, [](const auto& point) { return point.id == "lt_gap"; });
  EXPECT_EQ(disc_with(4, less), palmer("2C")) << "a ligament that has no place is well";
  grades[finding("disc")] = palmer("2D");
  EXPECT_EQ(disc_with(0, less), palmer("2C"));
}

TEST(PathologyTable, NamesTheEntryThatIsWrong) {
  EXPECT_THROW(PathologyTable::parse("{"), InvalidInput);
  const auto text = [](const std::string& shows, const std::string& scale, double chance) {
    return R"({"opened_by_n":{"value":34},"healthy_share":{"value":0},"scales":[{"id":"s","name":"","is_ordered":false,"grades":[{"id":"0","label":"w"},{"id":"1","label":"x","shows":")" +
           shows + R"(","radius_mm":1}]}],"findings":[{"id":"f","label":"F","scale":")" + scale +
           R"(","chance":)" + std::to_string(chance) + R"(,"at":"disc"}]})";
  };
  EXPECT_EQ(PathologyTable::parse(text("tear", "s", 0.5)).findings.size(), 1U);
  EXPECT_THROW(PathologyTable::parse(text("glow", "s", 0.5)), InvalidInput);
  EXPECT_THROW(PathologyTable::parse(text("tear", "t", 0.5)), InvalidInput);
  EXPECT_THROW(PathologyTable::parse(text("tear", "s", 1.5)), InvalidInput);
}

}  // namespace
}  // namespace carpus::arthroscopy

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/make_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "arthroscopy/generic_wrist_test_support.hpp"
#include "arthroscopy/opened_space.hpp"
#include "arthroscopy/portal_table.hpp"
#include "cases/joint_under_block.hpp"
#include "cases/make_structures.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

class MakeMap : public testing::Test {
 protected:
  [[nodiscard]] Vec3 in_wrist(const Vec3& v) const {
    return (data_->wrist_from_patient * Point<frame::Patient>{v}).v;
  }

  const cases::CaseData* data_ = &test::generic_wrist().data;
  const soft_tissue::SoftTissue* tissue_ = &test::generic_wrist().tissue;
  const cases::ArthroscopicMap* map_ = &test::generic_wrist().map;
};

TEST_F(MakeMap, PortalsLieOnTheirSideAndTheirWaysLeadIntoTheJoint) {
  ASSERT_NE(find_portal(*map_, "3-4"), nullptr) << ::testing::PrintToString(map_->problems);
  ASSERT_NE(find_portal(*map_, "4-5"), nullptr);
  for (const cases::Portal& portal : map_->portals) {
    const double volar_mm = in_wrist(portal.skin).z;
    EXPECT_TRUE(!portal.is_usual || volar_mm < -5) << portal.id << " is dorsal";
    EXPECT_TRUE(portal.id.front() != 'V' || volar_mm > 5) << portal.id << " is volar";
    EXPECT_GE(portal.room_mm, kLeastRoomMm);
    // Where the bones are as the hand is pulled.
    anatomy::HandPose pulled = data_->hand_motion.scan;
    pulled.traction_n = PortalTable::generic().traction_n;
    const auto pose_of = [&](std::uint8_t body) {
      return cases::pose_under_block(data_->hand_motion, data_->bones[body].bone, pulled);
    };
    const cases::JointSpace& joint = map_->joints[portal.joint];
    const auto beyond_capsule = [&](double mm) {
      const Vec3 at = portal.skin + portal.inwards * (portal.capsule_mm + mm);
      return opened_space_at(joint.wall, pose_of(joint.proximal).inverse(),
                             pose_of(joint.distal).inverse(),
                             (pose_of(portal.body) * Point<frame::Bone>{at}).v)
          .distance_mm;
    };
    EXPECT_LT(beyond_capsule(1.5), 0) << portal.id;
    EXPECT_GT(beyond_capsule(-1.5), 0) << portal.id;
  }
}

/// A tendon laid across a portal's way: the way goes beside it, and the map says how far.
TEST_F(MakeMap, WaysKeepClearOfATendonThatWasLaidInThem) {
  ASSERT_NE(find_portal(*map_, "6R"), nullptr) << ::testing::PrintToString(map_->problems);
  const cases::Portal& before = *find_portal(*map_, "6R");
  cases::CaseData data = *data_;
  cases::Structure tube{"tube", "a tendon",     anatomy::StructureKind::Tendon,
                        0.5,    BoneId::Radius, {}};
  const Vec3 middle = before.skin + before.inwards * (before.capsule_mm * 0.5);
  for (int i = -20; i <= 20; ++i) tube.course.push_back({middle + map_->distal * i, 0.0});
  data.structures = {tube};
  const cases::ArthroscopicMap map = make_map(data, *tissue_);
  const cases::Portal* after = find_portal(map, "6R");
  ASSERT_NE(after, nullptr);
  const auto& beside = after->beside[static_cast<std::size_t>(anatomy::StructureKind::Tendon)];
  ASSERT_TRUE(beside.has_value());
  EXPECT_GE(beside->mm, kLeastRoomMm - 1e-6);
  EXPECT_FALSE(after->beside[static_cast<std::size_t>(anatomy::StructureKind::Nerve)].has_value());

  // Where there is no way without, the portal stays and the map says what it cuts.
  data.structures[0].radius_mm = 30;
  const cases::ArthroscopicMap none = make_map(data, *tissue_);
  EXPECT_NE(find_portal(none, "6R"), nullptr);
  EXPECT_TRUE(std::any_of(none.problems.begin(), none.problems.end(), [](const auto& p) {
    return p.find("into the a tendon") != std::string::npos;
  }));
}

/// What a way must spare has to be there: a case of an older program has no ulnar artery.
TEST_F(MakeMap, TheVolarUlnarPortalIsOfferedWhereWhatItMustSpareIsThere) {
  ASSERT_TRUE(data_->structures.empty());
  EXPECT_EQ(find_portal(*map_, "VU"), nullptr);
  EXPECT_TRUE(std::any_of(map_->problems.begin(), map_->problems.end(), [](const auto& p) {
    return p.find("volar ulnar portal: not offered") == 0 &&
           p.find("ulnar artery, ulnar nerve, median nerve") != std::string::npos;
  })) << ::testing::PrintToString(map_->problems);

  cases::CaseData data = *data_;
  data.structures = cases::make_structures(data).structures;
  const cases::ArthroscopicMap map = make_map(data, *tissue_);
  const cases::Portal* portal = find_portal(map, "VU");
  ASSERT_NE(portal, nullptr) << ::testing::PrintToString(map.problems);
  EXPECT_GT(in_wrist(portal->skin).z, 5) << "volar";
  for (const auto kind : {anatomy::StructureKind::Artery, anatomy::StructureKind::Nerve}) {
    const auto& beside = portal->beside[static_cast<std::size_t>(kind)];
    ASSERT_TRUE(beside.has_value());
    EXPECT_GT(beside->mm, 2.0) << data.structures[beside->structure].name;
    EXPECT_LT(beside->mm, 12.0) << data.structures[beside->structure].name;
  }
  for (const char* usual : {"3-4", "4-5", "6R", "MCR", "MCU"}) {
    EXPECT_NE(find_portal(map, usual), nullptr) << usual;
  }
}

/// Radial of MCR, with room; that it is ulnar of the long thumb extensor the search itself holds.
TEST_F(MakeMap, TheSttPortalLeadsBesideTheLongThumbExtensorIntoTheMidcarpalJoint) {
  cases::CaseData data = *data_;
  data.structures = cases::make_structures(data).structures;
  const cases::ArthroscopicMap map = make_map(data, *tissue_);
  const cases::Portal* portal = find_portal(map, "STT");
  ASSERT_NE(portal, nullptr) << ::testing::PrintToString(map.problems);
  EXPECT_FALSE(portal->is_usual);
  EXPECT_EQ(map.joints[portal->joint].id, "midcarpal");
  EXPECT_GE(portal->room_mm, kLeastRoomMm);
  const Vec3 inside = portal->skin + portal->inwards * portal->capsule_mm;
  EXPECT_GT(in_wrist(inside).y, in_wrist(find_portal(map, "MCR")->skin).y) << "radial is y";
  const auto& artery = portal->beside[static_cast<std::size_t>(anatomy::StructureKind::Artery)];
  ASSERT_TRUE(artery.has_value());
  EXPECT_EQ(data.structures[artery->structure].id, "radial_artery");
  EXPECT_GT(artery->mm, 1.0);
}

/// [S80]: about 1 cm ulnar of the 3-4 portal; and 3-4 is distal of Lister's tubercle.
TEST_F(MakeMap, TheSecondPortalIsACentimetreUlnarOfTheFirst) {
  const Vec3 first = in_wrist(find_portal(*map_, "3-4")->skin);
  const Vec3 second = in_wrist(find_portal(*map_, "4-5")->skin);
  EXPECT_NEAR(first.y - second.y, 10, 4) << "ulnar is -y of a right wrist";
}

/// [K]: MCR about 1 cm distal to 3-4, MCU 1 to 1.5 cm distal to 4-5; both into the other joint.
TEST_F(MakeMap, MidcarpalPortalsLieACentimetreDistalOfTheRadiocarpalOnes) {
  for (const auto& [midcarpal, radiocarpal] : {std::pair{"MCR", "3-4"}, std::pair{"MCU", "4-5"}}) {
    const cases::Portal* distal = find_portal(*map_, midcarpal);
    ASSERT_NE(distal, nullptr) << midcarpal << ::testing::PrintToString(map_->problems);
    EXPECT_EQ(map_->joints[distal->joint].id, "midcarpal");
    const double by = in_wrist(find_portal(*map_, radiocarpal)->skin).x - in_wrist(distal->skin).x;
    EXPECT_GT(by, 5) << midcarpal;
    EXPECT_LT(by, 20) << midcarpal;
  }
}

TEST_F(MakeMap, ThePointsOfTheTourLieOnTheJointsWall) {
  EXPECT_EQ(map_->points.size(), PortalTable::generic().points.size())
      << ::testing::PrintToString(map_->problems);
  EXPECT_EQ(map_->points.size(), 24U) << "[K, B8]";
  for (const cases::TourPoint& point : map_->points) {
    const Grid<float>& wall = map_->joints[point.joint].wall;
    EXPECT_NEAR(fields::sample_distance(wall, point.at).distance_mm, 0, 0.3) << point.id;
    EXPECT_FALSE(point.by.empty()) << point.id;
    for (const std::uint8_t by : point.by) {
      EXPECT_EQ(map_->portals[by].joint, point.joint) << point.id << ": from its own joint";
    }
  }
  for (const TabledPoint& tabled : PortalTable::generic().points) {
    for (const cases::TourPoint& point : map_->points) {
      if (!tabled.on || point.id != tabled.id) continue;
      EXPECT_EQ(data_->bones[point.body].bone, *tabled.on) << point.id;
    }
  }
}

TEST_F(MakeMap, TheJointsCartilageIsOfFourBonesAtLeastAndFacesIt) {
  std::array<std::array<double, 16>, cases::kMaxJoints> area{};
  for (const cases::CartilageFacet& f : map_->cartilage) {
    area.at(f.joint)[static_cast<std::size_t>(data_->bones[f.body].bone)] += f.area_mm2;
    EXPECT_NEAR(length(f.normal), 1, 1e-9);
  }
  for (const BoneId bone : {BoneId::Radius, BoneId::Scaphoid, BoneId::Lunate}) {
    EXPECT_GT(area[0][static_cast<std::size_t>(bone)], 80) << name_of(bone);
  }
  EXPECT_LT(area[0][static_cast<std::size_t>(BoneId::Capitate)], 5);
  for (const BoneId bone : {BoneId::Scaphoid, BoneId::Lunate, BoneId::Capitate, BoneId::Hamate}) {
    EXPECT_GT(area[1][static_cast<std::size_t>(bone)], 40) << name_of(bone);
  }
  EXPECT_LT(area[1][static_cast<std::size_t>(BoneId::Radius)], 5);
}

TEST_F(MakeMap, NamesWhatIsMissingAndGoesOn) {
  soft_tissue::SoftTissue less = *tissue_;
  std::erase_if(less.ligaments, [](const auto& l) { return l.id == "RSC"; });
  const cases::ArthroscopicMap without = make_map(*data_, less);
  EXPECT_EQ(without.points.size() + 1, map_->points.size());
  EXPECT_EQ(without.problems.size(), map_->problems.size() + 1);

  std::erase_if(less.spaces, [](const auto& space) { return space.id == "midcarpal"; });
  const cases::ArthroscopicMap proximal = make_map(*data_, less);
  EXPECT_EQ(find_portal(proximal, "MCR"), nullptr);
  EXPECT_NE(find_portal(proximal, "3-4"), nullptr);
  EXPECT_EQ(proximal.points.size(), 16U) << "those of the radiocarpal joint but one";
  EXPECT_TRUE(std::any_of(proximal.problems.begin(), proximal.problems.end(),
                          [](const auto& p) { return p.find("midcarpal") != std::string::npos; }));

  less.spaces.clear();
  const cases::ArthroscopicMap none = make_map(*data_, less);
  EXPECT_TRUE(none.is_empty());
  EXPECT_FALSE(none.problems.empty());
}

TEST(PortalTable, NamesTheEntryThatIsWrong) {
  EXPECT_THROW(PortalTable::parse("{"), InvalidInput);
  EXPECT_THROW(
      PortalTable::parse(R"({"traction_n":{"value":1},"portals":[{"id":"x"}],"points":[]})"),
      InvalidInput);
  EXPECT_THROW(
      PortalTable::parse(
          R"({"traction_n":{"value":1},"joints":[],"portals":[],"points":[{"number":1,"id":"a","name":"a","found_by":"b","joint":"x","by":[]}]})"),
      InvalidInput);
  // Whole, but for a portal that is not there, a joint that is not, a number without a bit.
  const auto table = [](const std::string& number, const std::string& joint,
                        const std::string& by) {
    return R"({"traction_n":{"value":1},"joints":[{"id":"j","name":"j","between":["radius","lunate"]}],"portals":[],"points":[{"number":)" +
           number + R"(,"id":"a","name":"a","found_by":"b","joint":")" + joint + R"(","by":[)" +
           by + R"(],"disc":true}]})";
  };
  EXPECT_EQ(PortalTable::parse(table("1", "j", "")).points.size(), 1U);
  EXPECT_THROW(PortalTable::parse(table("1", "j", R"("3-4")")), InvalidInput);
  EXPECT_THROW(PortalTable::parse(table("1", "k", "")), InvalidInput);
  EXPECT_THROW(PortalTable::parse(table("32", "j", "")), InvalidInput);
}

}  // namespace
}  // namespace carpus::arthroscopy

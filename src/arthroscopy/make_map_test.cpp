// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/make_map.hpp"

#include <gtest/gtest.h>

#include "arthroscopy/portal_table.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"
#include "soft_tissue/make_soft_tissue.hpp"
#include "soft_tissue/model_case_test_support.hpp"

namespace carpus::arthroscopy {
namespace {

/// The generic wrist, right and turned; made once.
class MakeMap : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Mat3 turned = Mat3::from_columns({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
    data_ = new cases::CaseData(soft_tissue::test::model_case(Side::Right, 1.05, turned));
    for (cases::Bone& bone : data_->bones) {
      bone.distance_field = fields::build_distance_field(bone.surface, {0.6, 4.0});
    }
    tissue_ = new soft_tissue::SoftTissue(soft_tissue::make_soft_tissue(*data_));
    map_ = new cases::ArthroscopicMap(make_map(*data_, *tissue_));
  }
  static void TearDownTestSuite() {
    delete map_;
    delete tissue_;
    delete data_;
  }
  static Vec3 in_wrist(const Vec3& v) {
    return (data_->wrist_from_patient * Point<frame::Patient>{v}).v;
  }

  static cases::CaseData* data_;
  static soft_tissue::SoftTissue* tissue_;
  static cases::ArthroscopicMap* map_;
};
cases::CaseData* MakeMap::data_ = nullptr;
soft_tissue::SoftTissue* MakeMap::tissue_ = nullptr;
cases::ArthroscopicMap* MakeMap::map_ = nullptr;

TEST_F(MakeMap, PortalsLieDorsallyAndTheirWaysLeadIntoTheJoint) {
  ASSERT_NE(find_portal(*map_, "3-4"), nullptr) << ::testing::PrintToString(map_->problems);
  ASSERT_NE(find_portal(*map_, "4-5"), nullptr);
  for (const cases::Portal& portal : map_->portals) {
    EXPECT_LT(in_wrist(portal.skin).z, -5) << portal.id << " is dorsal";
    EXPECT_GE(portal.room_mm, kLeastRoomMm);
    const Vec3 within = portal.skin + portal.inwards * (portal.capsule_mm + 1.5);
    EXPECT_LT(fields::sample_distance(map_->space, within).distance_mm, 0) << portal.id;
    const Vec3 before = portal.skin + portal.inwards * (portal.capsule_mm - 1.5);
    EXPECT_GT(fields::sample_distance(map_->space, before).distance_mm, 0) << portal.id;
  }
}

/// [S80]: about 1 cm ulnar of the 3-4 portal; and 3-4 is distal of Lister's tubercle.
TEST_F(MakeMap, TheSecondPortalIsACentimetreUlnarOfTheFirst) {
  const Vec3 first = in_wrist(find_portal(*map_, "3-4")->skin);
  const Vec3 second = in_wrist(find_portal(*map_, "4-5")->skin);
  EXPECT_NEAR(first.y - second.y, 10, 4) << "ulnar is -y of a right wrist";
}

TEST_F(MakeMap, ThePointsOfTheTourLieOnTheJointsWall) {
  EXPECT_EQ(map_->points.size(), PortalTable::generic().points.size());
  for (const cases::TourPoint& point : map_->points) {
    EXPECT_NEAR(fields::sample_distance(map_->space, point.at).distance_mm, 0, 0.3) << point.id;
  }
  for (const TabledPoint& tabled : PortalTable::generic().points) {
    for (const cases::TourPoint& point : map_->points) {
      if (!tabled.on || point.id != tabled.id) continue;
      EXPECT_EQ(data_->bones[point.body].bone, *tabled.on) << point.id;
    }
  }
}

TEST_F(MakeMap, TheJointsCartilageIsOfFourBonesAtLeastAndFacesIt) {
  std::array<double, 16> area{};
  for (const cases::CartilageFacet& f : map_->cartilage) {
    area[static_cast<std::size_t>(data_->bones[f.body].bone)] += f.area_mm2;
    EXPECT_NEAR(length(f.normal), 1, 1e-9);
  }
  for (const BoneId bone : {BoneId::Radius, BoneId::Scaphoid, BoneId::Lunate}) {
    EXPECT_GT(area[static_cast<std::size_t>(bone)], 80) << name_of(bone);
  }
  EXPECT_LT(area[static_cast<std::size_t>(BoneId::Capitate)], 5);
}

TEST_F(MakeMap, NamesWhatIsMissingAndGoesOn) {
  soft_tissue::SoftTissue less = *tissue_;
  std::erase_if(less.ligaments, [](const auto& l) { return l.id == "RSC"; });
  const cases::ArthroscopicMap without = make_map(*data_, less);
  EXPECT_EQ(without.points.size() + 1, map_->points.size());
  EXPECT_EQ(without.problems.size(), map_->problems.size() + 1);

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
          R"({"traction_n":{"value":1},"portals":[],"points":[{"number":1,"id":"a","name":"a","found_by":"b"}]})"),
      InvalidInput);
}

}  // namespace
}  // namespace carpus::arthroscopy

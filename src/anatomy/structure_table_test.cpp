// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/structure_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "anatomy/wrist_model.hpp"
#include "core/error.hpp"

namespace carpus::anatomy {
namespace {

std::string table_with(const std::string& structure) {
  return R"({"schema_version": 1, "at_a_portal": {"tendon": "t", "artery": "a", "nerve": "n"}, "landmarks": [{"id": "lister", "bone": "radius", "at_mm": [5, 0, -11],
    "words": "w", "mark": "[E]"}], "structures": [)" +
         structure + R"(], "portals": []})";
}

std::string tendon(const std::string& first_point, const std::string& more = "") {
  return R"({"id": "t", "name": "a tendon", "kind": "tendon", "radius_mm": 1, "forearm": "radius",
    "length_mm": [5, 20], "mark": "[K]", "avoid": "spread", )" +
         more + R"("course": [)" + first_point + R"(, {"from": "lister", "distal_mm": 10}]})";
}

TEST(StructureTable, HoldsWhatADorsalAndAVolarEntryCanHarm) {
  const StructureTable& table = StructureTable::generic();
  for (const char* id :
       {"apl_epb",      "ecrl",        "ecrb",        "epl",           "edc_index",
        "edm",          "ecu",         "fcr",         "radial_artery", "radial_artery_palmar",
        "sbrn_index",   "sbrn_thumb",  "sbrn_volar",  "dsbun",         "fcu",
        "fds_radial",   "fds_ulnar",   "fdp_radial",  "fdp_ulnar",     "fpl",
        "ulnar_artery", "ulnar_nerve", "median_nerve"}) {
    EXPECT_NE(table.find(id), nullptr) << id;
  }
  EXPECT_EQ(table.find("nothing"), nullptr);
  EXPECT_EQ(table.find("epl")->kind, StructureKind::Tendon);
  EXPECT_EQ(table.find("radial_artery")->kind, StructureKind::Artery);
  EXPECT_EQ(table.find("dsbun")->kind, StructureKind::Nerve);
  EXPECT_EQ(table.find("ecu")->forearm, BoneId::Ulna);
  EXPECT_EQ(table.find("ulnar_nerve")->kind, StructureKind::Nerve);
  EXPECT_EQ(table.find("ulnar_artery")->kind, StructureKind::Artery);
  for (const TabledStructure& s : table.structures) EXPECT_FALSE(s.avoid.empty()) << s.id;
}

TEST(StructureTable, ItsLandmarksLieOnTheGenericBones) {
  const WristModel& model = WristModel::generic(Side::Left);
  for (const Landmark& landmark : StructureTable::generic().landmarks) {
    EXPECT_LT(std::abs(model.signed_value(landmark.bone, landmark.at)), 1.5) << landmark.id;
  }
}

TEST(StructureTable, TakesDistalUlnarDorsalAndTheLayer) {
  const StructureTable table = StructureTable::parse(table_with(tendon(
      R"({"from": "lister", "distal_mm": 3, "ulnar_mm": 2, "dorsal_mm": 1, "gap_mm": 0.5})")));
  const Place& place = table.structures.at(0).course.at(0);
  EXPECT_EQ(place.offset, (Vec3{-3, 2, -1}));
  EXPECT_EQ(place.layer, Layer::OverBone);
  EXPECT_EQ(place.millimetres, 0.5);
  EXPECT_EQ(table.structures.at(0).course.at(1).layer, Layer::AsPlaced);
}

TEST(StructureTable, RefusesWhatItDoesNotKnowAndSaysWhere) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      (void)StructureTable::parse(text);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  const std::string point = R"({"from": "lister", "gap_mm": 1})";
  EXPECT_EQ(refusal(table_with(tendon(point))), "");
  EXPECT_NE(refusal(table_with(tendon(R"({"from": "styloid"})"))).find("t: there is no landmark"),
            std::string::npos);
  EXPECT_NE(refusal(table_with(tendon(point, R"("colour": 1, )"))).find("colour"),
            std::string::npos);
  EXPECT_NE(refusal(table_with(tendon(R"({"from": "lister", "gap_mm": 1, "depth_mm": 2})")))
                .find("not both"),
            std::string::npos);
  EXPECT_NE(refusal(table_with(tendon(point) + "," + tendon(point))).find("twice"),
            std::string::npos);
  EXPECT_NE(refusal("{").find("structures: the table"), std::string::npos);
}

}  // namespace
}  // namespace carpus::anatomy

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/soft_tissue_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "case_io/small_tissue_test_support.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;
using soft_tissue::SoftTissue;
using test::small_tissue;
using ::testing::HasSubstr;

class SoftTissueFolder : public ::testing::Test {
 protected:
  SoftTissueFolder() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "case.json") << "{}";
    data_.bones.resize(1);
    data_.bones[0].bone = BoneId::Scaphoid;
    data_.bones[0].label = 3;
  }
  ~SoftTissueFolder() override { fs::remove_all(folder_); }

  void change(const std::string& from, const std::string& to) const {
    const fs::path file = folder_ / "soft_tissue" / "soft_tissue.json";
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::ofstream(file) << text.replace(at, from.size(), to);
  }
  template <typename Error>
  std::string refusal() const {
    try {
      (void)read_soft_tissue(folder_);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path folder_ = fs::path(::testing::TempDir()) / "carpus_soft_tissue_folder";
  cases::CaseData data_;
};

TEST_F(SoftTissueFolder, ComesBackAsItWas) {
  EXPECT_FALSE(read_soft_tissue(folder_));
  const SoftTissue tissue = small_tissue();
  write_soft_tissue(tissue, data_, folder_);
  write_soft_tissue(tissue, data_, folder_);
  const auto back = read_soft_tissue(folder_);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->size, tissue.size);
  EXPECT_EQ(back->problems, tissue.problems);
  EXPECT_EQ(back->deepest_in_other_mm, tissue.deepest_in_other_mm);
  ASSERT_EQ(back->overlaps.size(), 1U);
  EXPECT_EQ(back->overlaps[0].first, "SL_dorsal");
  EXPECT_EQ(back->overlaps[0].second, "extensor pollicis longus");
  EXPECT_EQ(back->overlaps[0].mm, 0.25);
  const soft_tissue::Strand& s = back->ligaments.at(0).strands.at(0);
  EXPECT_EQ(s.course, tissue.ligaments[0].strands[0].course);
  EXPECT_EQ(s.anchors.at(0).label, 3);
  EXPECT_EQ(s.anchors.at(1).ligament, "VRUL");
  EXPECT_EQ(back->cartilage.at(0).vertex_thickness_mm, tissue.cartilage[0].vertex_thickness_mm);
  EXPECT_EQ(back->cartilage[0].pressed_area_mm2, tissue.cartilage[0].pressed_area_mm2);
  EXPECT_EQ(back->cartilage[0].pressed_thickness_mm, tissue.cartilage[0].pressed_thickness_mm);
  EXPECT_EQ(back->spaces.at(0).lining, tissue.spaces[0].lining);
  EXPECT_EQ(back->disc.body.vertices, tissue.disc.body.vertices);
  EXPECT_TRUE(fs::exists(folder_ / "soft_tissue" / "cartilage_scaphoid.ply"));
}

TEST_F(SoftTissueFolder, EachSurfaceSaysByItselfThatItIsGenerated) {
  write_soft_tissue(small_tissue(), data_, folder_);
  std::size_t surfaces = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "soft_tissue")) {
    if (entry.path().extension() != ".ply") continue;
    ++surfaces;
    std::ifstream file(entry.path(), std::ios::binary);
    std::string head(400, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    EXPECT_NE(head.find("comment Generated"), std::string::npos) << entry.path();
  }
  EXPECT_GE(surfaces, 3U);
}

TEST_F(SoftTissueFolder, DamageIsNamed) {
  const auto damaged = [&](const std::string& from, const std::string& to) {
    write_soft_tissue(small_tissue(), data_, folder_);
    change(from, to);
    return refusal<IoError>();
  };
  EXPECT_THAT(damaged("carpus soft tissue", "something"), HasSubstr("soft_tissue.json"));
  EXPECT_THAT(damaged("disc.ply", "../case.json"), HasSubstr("no name of a surface's file"));
  EXPECT_THAT(damaged("\"lining\":\"1", "\"lining\":\"9"), HasSubstr("lining"));
  EXPECT_THAT(damaged("\"point\":1", "\"point\":7"), HasSubstr("beyond its course"));
  EXPECT_THAT(damaged("\"fraction\":0.45", "\"fraction\":-3"), HasSubstr("impossible"));
  for (const char* point : {"0.5", "-1", "1e300", "\"1\""}) {
    EXPECT_THAT(damaged("\"point\":1", std::string("\"point\":") + point), HasSubstr("not whole"));
  }
  // A bone that is none would be held by the air, at the place where bone 0 is.
  EXPECT_THAT(damaged("{\"label\":3", "{\"label\":0"), HasSubstr("impossible"));
  EXPECT_THAT(damaged("{\"label\":3", "{\"label\":2.5"), HasSubstr("not whole"));
  write_soft_tissue(small_tissue(), data_, folder_);
  change("\"schema_version\":1", "\"schema_version\":2");
  EXPECT_THAT(refusal<SchemaError>(), HasSubstr("newer program"));
  EXPECT_THROW(write_soft_tissue(small_tissue(), data_, folder_ / "nowhere"), IoError);
}

}  // namespace
}  // namespace carpus::case_io

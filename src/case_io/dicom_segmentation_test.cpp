// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/dicom_segmentation.hpp"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>
#include <dcmtk/dcmseg/segutils.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "case_io/two_bones_test_support.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;

using test::two_bones;

class DicomSegmentation : public testing::Test {
 protected:
  DicomSegmentation() {
    std::string name = testing::TempDir() + "/seg_XXXXXX";
    file_ = std::string(::mkdtemp(name.data())) + "/labels.dcm";
  }
  ~DicomSegmentation() override {
    std::error_code ignored;
    fs::remove_all(fs::path(file_).parent_path(), ignored);
  }
  void write(const Grid<std::uint8_t>& labels) const {
    write_dicom_segmentation(file_, labels.view(),
                             {{3, "scaphoid"}, {4, "lunate"}, {9, "capitate"}},
                             {"demo wrist", true, "carpus 0.1.0"});
  }
  std::string file_;
};

TEST_F(DicomSegmentation, IsReadBackByDcmtkVoxelByVoxel) {
  const Grid<std::uint8_t> labels = two_bones();
  write(labels);
  DcmSegmentation* loaded = nullptr;
  ASSERT_TRUE(DcmSegmentation::loadFile(file_.c_str(), loaded).good());
  const std::unique_ptr<DcmSegmentation> object(loaded);
  ASSERT_EQ(object->getNumberOfSegments(), 2U);  // no lunate is there
  Grid<std::uint8_t> back(labels.geometry());
  constexpr Uint16 kColumns = 16;  // 13, filled up
  const std::pair<const char*, std::uint8_t> expected[] = {{"scaphoid", 3}, {"capitate", 9}};
  for (std::size_t s = 1; s <= 2; ++s) {
    OFString label;
    object->getSegment(s)->getSegmentLabel(label);
    EXPECT_STREQ(label.c_str(), expected[s - 1].first);
    OFVector<size_t> frames;
    object->getFramesForSegment(s, frames);
    for (const size_t f : frames) {
      const std::unique_ptr<DcmIODTypes::Frame> pixels(
          DcmSegUtils::unpackBinaryFrame(object->getFrame(f), 11, kColumns));
      ASSERT_NE(pixels, nullptr);
      OFBool is_per_frame = OFFalse;
      auto* position =
          OFstatic_cast(FGPlanePosPatient*,
                        object->getFunctionalGroups().get(
                            static_cast<Uint32>(f), DcmFGTypes::EFG_PLANEPOSPATIENT, is_per_frame));
      ASSERT_NE(position, nullptr);
      Float64 x = 0, y = 0, z = 0;
      ASSERT_TRUE(position->getImagePositionPatient(x, y, z).good());
      const Vec3 v = labels.geometry().voxel_from_patient({x, y, z});
      EXPECT_NEAR(v.x, 0, 1e-6);
      EXPECT_NEAR(v.y, 0, 1e-6);
      const int slice = static_cast<int>(std::lround(v.z));
      for (int row = 0; row < 11; ++row) {
        for (int column = 0; column < kColumns; ++column) {
          if (pixels->pixData[row * kColumns + column] == 0) continue;
          ASSERT_LT(column, 13);
          back[VoxelIndex{column, row, slice}] = expected[s - 1].second;
        }
      }
    }
  }
  EXPECT_TRUE(std::equal(labels.values().begin(), labels.values().end(), back.values().begin()));
}

TEST_F(DicomSegmentation, IsTheSameFileEachTimeAndHoldsNobody) {
  const auto bytes = [&] {
    std::ifstream in(file_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  write(two_bones());
  const std::string first = bytes();
  write(two_bones());
  EXPECT_TRUE(first == bytes());
  // Today is in it nowhere: it would be another file a second later.
  const std::time_t now = std::time(nullptr);
  char today[16] = {};
  std::strftime(today, sizeof today, "%Y%m%d", std::localtime(&now));
  EXPECT_EQ(first.find(today), std::string::npos);
  EXPECT_NE(first.find("demo wrist"), std::string::npos);
  EXPECT_NE(first.find("simulated"), std::string::npos);
}

TEST_F(DicomSegmentation, PassesTheVerifierWhereThatIsInstalled) {
  if (!fs::exists("/usr/bin/dciodvfy")) GTEST_SKIP() << "dicom3tools is not installed";
  write(two_bones());
  const std::string command = "/usr/bin/dciodvfy '" + file_ + "' 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string said;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) {
    said += static_cast<char>(c);
  }
  EXPECT_NE(said.find("Segmentation"), std::string::npos) << said;
  EXPECT_EQ(said.find("Error"), std::string::npos) << said;
}

TEST_F(DicomSegmentation, RefusesWhatTheFormatCannotHold) {
  Grid<std::uint8_t> nothing(two_bones().geometry());
  EXPECT_THROW(write(nothing), InvalidInput);
  GridGeometry mirrored = two_bones().geometry();
  mirrored.direction = Mat3::from_columns({-1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_THROW(write(Grid<std::uint8_t>(mirrored, 3)), InvalidInput);
  file_ = "/nowhere/at/all.dcm";
  EXPECT_THROW(write(two_bones()), IoError);
}

}  // namespace
}  // namespace carpus::case_io

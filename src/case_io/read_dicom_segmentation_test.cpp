// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/read_dicom_segmentation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "case_io/dicom_segmentation.hpp"
#include "case_io/two_bones_test_support.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;
using test::two_bones;
using ::testing::HasSubstr;

class ReadDicomSegmentation : public testing::Test {
 protected:
  ReadDicomSegmentation() {
    std::string name = testing::TempDir() + "/seg_XXXXXX";
    file_ = std::string(::mkdtemp(name.data())) + "/labels.dcm";
    write_dicom_segmentation(file_, two_bones().view(), {{3, "scaphoid"}, {9, "capitate"}},
                             {"demo wrist", true, "carpus 0.1.0"});
  }
  ~ReadDicomSegmentation() override {
    std::error_code ignored;
    fs::remove_all(fs::path(file_).parent_path(), ignored);
  }
  [[nodiscard]] std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void replace_bytes(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary) << bytes;
  }
  /// Why the file is refused; "" where it is not.
  [[nodiscard]] std::string refusal(const GridGeometry& onto) const {
    try {
      (void)read_dicom_segmentation(file_, onto);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::string file_;
};

TEST_F(ReadDicomSegmentation, GivesBackWhatWasWrittenVoxelByVoxel) {
  const Grid<std::uint8_t> labels = two_bones();
  const ReadSegmentation read = read_dicom_segmentation(file_, labels.geometry());
  EXPECT_EQ(read.names, (std::vector<std::string>{"scaphoid", "capitate"}));
  EXPECT_EQ(read.disputed, 0U);
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const int expected = labels[i] == 3 ? 1 : labels[i] == 9 ? 2 : 0;
    ASSERT_EQ(read.labels[i], expected);
  }
}

TEST_F(ReadDicomSegmentation, LiesRightOnAGridThatRunsTheOtherWay) {
  const Grid<std::uint8_t> labels = two_bones();
  GridGeometry turned = labels.geometry();
  const auto last = [&](std::size_t axis) { return labels.geometry().size[axis] - 1.0; };
  turned.origin = labels.geometry().patient_from_voxel({last(0), last(1), 0});
  turned.direction = Mat3::from_columns(-1 * labels.geometry().direction.column(0),
                                        -1 * labels.geometry().direction.column(1),
                                        labels.geometry().direction.column(2));
  const ReadSegmentation read = read_dicom_segmentation(file_, turned);
  EXPECT_EQ((read.labels[VoxelIndex{12, 0, 0}]), 1);
  EXPECT_EQ((read.labels[VoxelIndex{0, 0, 5}]), 2);
}

TEST_F(ReadDicomSegmentation, RefusesAnotherScansGrid) {
  GridGeometry coarser = two_bones().geometry();
  coarser.spacing.x = 0.6;
  EXPECT_THAT(refusal(coarser), HasSubstr("grid"));
  GridGeometry beside = two_bones().geometry();
  beside.origin.y += 0.2;
  EXPECT_THAT(refusal(beside), HasSubstr("grid"));
  GridGeometry smaller = two_bones().geometry();
  smaller.size[2] = 3;
  EXPECT_THAT(refusal(smaller), HasSubstr("outside the scan"));
}

TEST_F(ReadDicomSegmentation, RefusesWhatIsNoneOrDamaged) {
  const GridGeometry g = two_bones().geometry();
  const std::string whole = bytes();
  replace_bytes("");
  EXPECT_NE(refusal(g), "");
  replace_bytes(whole.substr(0, whole.size() - 40));
  EXPECT_NE(refusal(g), "");
  std::string other = whole;
  const std::string binary = "BINARY";
  other.replace(other.find(binary), binary.size(), "FRACTI");
  replace_bytes(other);
  EXPECT_THAT(refusal(g), HasSubstr("fractional"));
  fs::remove(file_);
  EXPECT_NE(refusal(g), "");
}

/// Where the value of an element with a short length begins, the n-th of its tag.
std::size_t value_at(const std::string& bytes, std::string_view tag_and_type, int nth = 0) {
  std::size_t at = bytes.find(tag_and_type);
  while (nth-- > 0) at = bytes.find(tag_and_type, at + 1);
  EXPECT_NE(at, std::string::npos);
  return at + tag_and_type.size() + 2;
}
using std::string_view_literals::operator""sv;
constexpr std::string_view kNumberOfFrames = "\x28\x00\x08\x00IS"sv;
constexpr std::string_view kSegmentNumber = "\x62\x00\x04\x00US"sv;
constexpr std::string_view kOrientation =
    "\x20\x00\x37\x00"
    "DS"sv;
constexpr std::string_view kPixels = "\xE0\x7F\x10\x00OB\x00\x00"sv;

TEST_F(ReadDicomSegmentation, RefusesWhatItSaysTwiceAndOtherwise) {
  const GridGeometry g = two_bones().geometry();
  const std::string whole = bytes();
  ASSERT_EQ(refusal(g), "");

  std::string changed = whole;
  changed[value_at(changed, kNumberOfFrames)] -= 1;
  replace_bytes(changed);
  EXPECT_THAT(refusal(g), HasSubstr("frames")) << "one fewer than it describes";

  changed = whole;
  changed[value_at(changed, kSegmentNumber, 1)] = 1;
  replace_bytes(changed);
  EXPECT_THAT(refusal(g), HasSubstr("two segments")) << "the same number";

  changed = whole;
  const std::size_t pixels = changed.find(kPixels) + kPixels.size();
  ASSERT_LT(pixels, changed.size());
  changed[pixels] = static_cast<char>(changed[pixels] + 2);
  changed.append(2, '\0');
  replace_bytes(changed);
  EXPECT_THAT(refusal(g), HasSubstr("pixels")) << "more than its frames have";

  replace_bytes(whole + std::string(8, '\0'));
  EXPECT_NE(refusal(g), "") << "more than a data set";
}

TEST_F(ReadDicomSegmentation, RefusesRowsAlongItsColumns) {
  GridGeometry square = two_bones().geometry();
  square.spacing.y = square.spacing.x;
  square.direction = Mat3::from_columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  write_dicom_segmentation(file_, Grid<std::uint8_t>(square, 3).view(), {{3, "scaphoid"}},
                           {"demo wrist", true, "carpus 0.1.0"});
  std::string changed = bytes();
  const std::size_t turn = value_at(changed, kOrientation);
  const auto length = static_cast<unsigned char>(changed[turn - 2]);
  std::string along = "1\\0\\0\\1\\0\\0";
  ASSERT_LE(along.size(), length);
  along.resize(length, ' ');
  changed.replace(turn, length, along);
  replace_bytes(changed);
  square.size[0] = 100;
  EXPECT_THAT(refusal(square), HasSubstr("rows along its columns"));
}

TEST_F(ReadDicomSegmentation, RefusesEveryCut) {
  const GridGeometry g = two_bones().geometry();
  const std::string whole = bytes();
  for (std::size_t size = 1; size < whole.size(); size += 97) {
    replace_bytes(whole.substr(0, whole.size() - size));
    EXPECT_NE(refusal(g), "") << size << " bytes cut off";
  }
}

/// Whatever a few changed bytes make of it: voxels or a refusal, and this process goes on.
TEST_F(ReadDicomSegmentation, OutlivesChangedBytes) {
  const std::string whole = bytes();
  Rng rng(5);
  for (int round = 0; round < 60; ++round) {
    std::string changed = whole;
    for (int k = 0; k < 4; ++k) {
      changed[132 + rng.below(changed.size() - 132)] = static_cast<char>(rng.below(256));
    }
    replace_bytes(changed);
    (void)refusal(two_bones().geometry());
  }
}

}  // namespace
}  // namespace carpus::case_io

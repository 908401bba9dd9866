// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One volume in the forms that archives and new scanners give it, written by DCMTK: words of big
// endian, and all slices as frames of one file. Each must be read as the plain series is.
#include <dcmtk/config/osconfig.h>
// (DCMTK's configuration must come first.)
#include <dcmtk/dcmdata/dctk.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <numeric>
#include <string>
#include <vector>

#include "case_io/detail/dicom_text.hpp"
#include "case_io/read_volume.hpp"
#include "case_io/write_volume.hpp"
#include "core/rng.hpp"
#include "geometry/mat3.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;

constexpr int kIntercept = -1024;

class DicomForms : public ::testing::Test {
 protected:
  DicomForms()
      : folder_(fs::temp_directory_path() /
                ("carpus_forms_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write_dicom_series(folder_ / "plain", scan().view(), {});
  }
  ~DicomForms() override { fs::remove_all(folder_); }

  /// Sides, spacings and axes that are all unlike: what is swapped is seen.
  static Grid<std::int16_t> scan() {
    GridGeometry g;
    g.size = {19, 14, 9};
    g.spacing = {0.3, 0.35, 0.625};
    g.origin = {-45.75, 12.25, 101.5};
    g.direction = rotation_about(normalized_or({0.3, 1, 0.2}, {0, 1, 0}), 0.21) *
                  rotation_about({0, 0, 1}, -0.13);
    Grid<std::int16_t> ct(g);
    Rng rng(11);
    // Of both bytes: -1024 to 3071.
    for (auto& v : ct.values()) v = static_cast<std::int16_t>(rng.below(4096) - 1024);
    return ct;
  }

  /// The voxels to the last bit, spacing and orientation as the plain series has them.
  void expect_as_plain(const fs::path& input) const {
    const Grid<std::int16_t> plain = read_ct(folder_ / "plain");
    const Grid<std::int16_t> truth = scan();
    ASSERT_TRUE(std::equal(plain.values().begin(), plain.values().end(), truth.values().begin()));
    const Grid<std::int16_t> read = read_ct(input);
    const GridGeometry& a = read.geometry();
    const GridGeometry& b = plain.geometry();
    ASSERT_EQ(a.size, b.size);
    EXPECT_EQ(a.spacing, b.spacing);
    EXPECT_EQ(a.origin, b.origin);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(a.direction.column(axis), b.direction.column(axis));
    }
    EXPECT_TRUE(std::equal(read.values().begin(), read.values().end(), plain.values().begin()));
  }

  fs::path folder_;
};

void put(DcmItem& item, const DcmTagKey& tag, const std::string& text) {
  ASSERT_TRUE(item.putAndInsertString(tag, text.c_str()).good()) << tag.toString();
}

std::string decimals(std::initializer_list<double> values) {
  std::string joined;
  for (const double v : values) joined += (joined.empty() ? "" : "\\") + decimal(v);
  return joined;
}

DcmItem& item_of(DcmItem& in, const DcmTagKey& sequence, long number = 0) {
  DcmItem* item = nullptr;
  EXPECT_TRUE(in.findOrCreateSequenceItem(sequence, item, number).good());
  return *item;
}

void put_place(DcmItem& group, const GridGeometry& g, int slice) {
  const Vec3 at = g.patient_from_voxel({0, 0, static_cast<double>(slice)});
  put(item_of(group, DCM_PlanePositionSequence), DCM_ImagePositionPatient,
      decimals({at.x, at.y, at.z}));
}

void put_orientation(DcmItem& group, const GridGeometry& g) {
  const Vec3 row = g.direction.column(0);
  const Vec3 column = g.direction.column(1);
  put(item_of(group, DCM_PlaneOrientationSequence), DCM_ImageOrientationPatient,
      decimals({row.x, row.y, row.z, column.x, column.y, column.z}));
}

void put_measures(DcmItem& group, const GridGeometry& g) {
  DcmItem& measures = item_of(group, DCM_PixelMeasuresSequence);
  put(measures, DCM_PixelSpacing, decimals({g.spacing.y, g.spacing.x}));
  put(measures, DCM_SliceThickness, decimal(g.spacing.z));
}

void put_values(DcmItem& group) {
  DcmItem& values = item_of(group, DCM_PixelValueTransformationSequence);
  put(values, DCM_RescaleIntercept, std::to_string(kIntercept));
  put(values, DCM_RescaleSlope, "1");
  put(values, DCM_RescaleType, "HU");
}

struct Form {
  E_TransferSyntax syntax = EXS_LittleEndianExplicit;
  bool per_frame = false;  ///< also what all frames share stands with each
  bool shuffled = false;   ///< frames in no order of their places
  bool is_signed = false;  ///< HU as they are, of 16 bits, without a rescale's shift
};

/// Enhanced CT Image Storage [dicom_ps3_3].
void write_enhanced(const fs::path& file, const Grid<std::int16_t>& ct, const Form& form) {
  const GridGeometry& g = ct.geometry();
  DcmFileFormat format;
  DcmDataset& data = *format.getDataset();
  put(data, DCM_SOPClassUID, UID_EnhancedCTImageStorage);
  put(data, DCM_SOPInstanceUID, "2.25.1");
  put(data, DCM_StudyInstanceUID, "2.25.2");
  put(data, DCM_SeriesInstanceUID, "2.25.3");
  put(data, DCM_FrameOfReferenceUID, "2.25.4");
  put(data, DCM_Modality, "CT");
  put(data, DCM_NumberOfFrames, std::to_string(g.size[2]));
  put(data, DCM_PhotometricInterpretation, "MONOCHROME2");
  const auto number = [&](const DcmTagKey& tag, int value) {
    ASSERT_TRUE(data.putAndInsertUint16(tag, static_cast<Uint16>(value)).good());
  };
  number(DCM_SamplesPerPixel, 1);
  number(DCM_Rows, g.size[1]);
  number(DCM_Columns, g.size[0]);
  number(DCM_BitsAllocated, 16);
  number(DCM_BitsStored, form.is_signed ? 16 : 12);
  number(DCM_HighBit, form.is_signed ? 15 : 11);
  number(DCM_PixelRepresentation, form.is_signed ? 1 : 0);
  std::vector<int> order(static_cast<std::size_t>(g.size[2]));
  std::iota(order.begin(), order.end(), 0);
  if (form.shuffled) {
    for (std::size_t i = 0; i < order.size(); ++i) std::swap(order[i], order[(5 * i + 2) % 9]);
  }
  const auto put_shared = [&](DcmItem& group) {
    put_measures(group, g);
    put_orientation(group, g);
    if (!form.is_signed) put_values(group);
  };
  if (!form.per_frame) put_shared(item_of(data, DCM_SharedFunctionalGroupsSequence));
  std::vector<Uint16> stored;
  const auto slice_size = static_cast<std::size_t>(g.size[0]) * static_cast<std::size_t>(g.size[1]);
  for (std::size_t i = 0; i < order.size(); ++i) {
    DcmItem& group = item_of(data, DCM_PerFrameFunctionalGroupsSequence, static_cast<long>(i));
    if (form.per_frame) put_shared(group);
    put_place(group, g, order[i]);
    const auto slice =
        ct.values().subspan(static_cast<std::size_t>(order[i]) * slice_size, slice_size);
    for (const std::int16_t hu : slice) {
      stored.push_back(static_cast<Uint16>(form.is_signed ? hu : hu - kIntercept));
    }
  }
  ASSERT_TRUE(data.putAndInsertUint16Array(DCM_PixelData, stored.data(), stored.size()).good());
  ASSERT_TRUE(format.saveFile(file.c_str(), form.syntax).good());
}

TEST_F(DicomForms, OfBigEndianWordsIsReadAsThePlainSeries) {
  const fs::path big = folder_ / "big";
  fs::create_directory(big);
  for (const auto& entry : fs::directory_iterator(folder_ / "plain")) {
    DcmFileFormat format;
    ASSERT_TRUE(format.loadFile(entry.path().c_str()).good());
    ASSERT_TRUE(
        format.saveFile((big / entry.path().filename()).c_str(), EXS_BigEndianExplicit).good());
  }
  expect_as_plain(big);
}

TEST_F(DicomForms, WithAllSlicesInOneFileIsReadAsThePlainSeries) {
  int number = 0;
  for (const E_TransferSyntax syntax :
       {EXS_LittleEndianExplicit, EXS_LittleEndianImplicit, EXS_BigEndianExplicit}) {
    for (const bool per_frame : {false, true}) {
      for (const bool shuffled : {false, true}) {
        for (const bool is_signed : {false, true}) {
          SCOPED_TRACE("syntax " + std::to_string(syntax) + (per_frame ? ", per frame" : "") +
                       (shuffled ? ", shuffled" : "") + (is_signed ? ", signed" : ""));
          const fs::path alone = folder_ / std::to_string(++number);
          fs::create_directory(alone);
          const fs::path file = alone / "frames.dcm";
          write_enhanced(file, scan(), {syntax, per_frame, shuffled, is_signed});
          expect_as_plain(file);
        }
      }
    }
  }
}

TEST_F(DicomForms, WithAFrameLeftOutNamesTheGap) {
  const Grid<std::int16_t> ct = scan();
  const fs::path whole = folder_ / "whole.dcm";
  const fs::path file = folder_ / "gap" / "frames.dcm";
  fs::create_directory(file.parent_path());
  write_enhanced(whole, ct, {});
  DcmFileFormat format;
  ASSERT_TRUE(format.loadFile(whole.c_str()).good());
  DcmItem& group = item_of(*format.getDataset(), DCM_PerFrameFunctionalGroupsSequence, 4);
  put_place(group, ct.geometry(), 20);
  ASSERT_TRUE(format.saveFile(file.c_str(), EXS_LittleEndianExplicit).good());
  std::string why = "accepted";
  try {
    (void)read_ct(file);
  } catch (const std::exception& error) {
    why = error.what();
  }
  EXPECT_NE(why.find("frames.dcm"), std::string::npos) << why;
  EXPECT_NE(why.find("mm"), std::string::npos) << why;
}

}  // namespace
}  // namespace carpus::case_io

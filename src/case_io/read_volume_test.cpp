// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/read_volume.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include "case_io/write_volume.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "geometry/mat3.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// NIfTI keeps positions as float32: 7 digits of 100 mm.
constexpr double kPlaceToleranceMm = 2e-5;

class ReadVolume : public ::testing::Test {
 protected:
  ReadVolume()
      : folder_(fs::temp_directory_path() /
                ("carpus_read_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ReadVolume() override { fs::remove_all(folder_); }

  [[nodiscard]] const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

Mat3 oblique_direction() {
  return rotation_about(normalized_or({0.3, 1, 0.2}, {0, 1, 0}), 0.21) *
         rotation_about({0, 0, 1}, -0.13);
}

/// A block of noise with air and bone, of unequal sides and spacings.
Grid<std::int16_t> test_ct(const Mat3& direction, int slices = 12) {
  GridGeometry g;
  g.size = {21, 17, slices};
  g.spacing = {0.3, 0.35, 0.625};
  g.origin = {-45.75, 12.25, 101.5};
  g.direction = direction;
  Grid<std::int16_t> ct(g);
  Rng rng(5);
  for (auto& v : ct.values()) v = static_cast<std::int16_t>(rng.below(3000)) - 1000;
  return ct;
}

void expect_same_volume(const Grid<std::int16_t>& a, const Grid<std::int16_t>& b) {
  ASSERT_EQ(a.geometry().size, b.geometry().size);
  EXPECT_TRUE(std::equal(a.values().begin(), a.values().end(), b.values().begin()));
  for (const Vec3 corner : {Vec3{0, 0, 0}, Vec3{20, 0, 0}, Vec3{0, 16, 0}, Vec3{20, 16, 11}}) {
    EXPECT_NEAR(
        distance(a.geometry().patient_from_voxel(corner), b.geometry().patient_from_voxel(corner)),
        0.0, kPlaceToleranceMm);
  }
}

/// The words of the error that reading `input` gives.
template <typename E>
std::string error_of(const fs::path& input, const ReadOptions& options = {}) {
  try {
    (void)read_ct(input, options);
  } catch (const E& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("another kind of error: ") + error.what();
  }
  return "no error";
}

void truncate_to(const fs::path& file, double ratio) {
  fs::resize_file(file,
                  static_cast<std::uintmax_t>(static_cast<double>(fs::file_size(file)) * ratio));
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Replaces one text in a file by another of the same length.
void patch(const fs::path& file, const std::string& from, const std::string& to) {
  std::string bytes = bytes_of(file);
  ASSERT_EQ(from.size(), to.size());
  const std::size_t at = bytes.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  bytes.replace(at, from.size(), to);
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(ReadVolume, GivesTheSameVolumeFromEveryFormat) {
  for (const Mat3& direction : {Mat3::identity(), oblique_direction()}) {
    const Grid<std::int16_t> ct = test_ct(direction);
    fs::remove_all(folder() / "series");
    write_dicom_series(folder() / "series", ct.view(), {});
    expect_same_volume(read_ct(folder() / "series"), ct);
    expect_same_volume(read_ct(folder() / "series" / "IM_0003.dcm"), ct);
    for (const char* name : {"v.nii", "v.nii.gz", "v.nrrd", "v.mha"}) {
      SCOPED_TRACE(name);
      write_volume<std::int16_t>(folder() / name, ct.view());
      expect_same_volume(read_ct(folder() / name), ct);
    }
  }
}

TEST_F(ReadVolume, TellsWhatAScanSaysAboutItselfInEveryFormat) {
  const Grid<std::int16_t> ct = test_ct(Mat3::identity());
  const std::string words = "simulated wrist, seed 18446744073709551615";
  for (const char* name : {"v.nii", "v.nii.gz", "v.nrrd", "v.mha"}) {
    SCOPED_TRACE(name);
    write_volume<std::int16_t>(folder() / name, ct.view(), words);
    EXPECT_EQ(read_description(folder() / name), words);
    expect_same_volume(read_ct(folder() / name), ct);
    write_volume<std::int16_t>(folder() / name, ct.view());
    EXPECT_EQ(read_description(folder() / name), "");
  }
  DicomDescription description;
  description.series_description = words;
  write_dicom_series(folder() / "series", ct.view(), description);
  EXPECT_EQ(read_description(folder() / "series"), words);
  EXPECT_EQ(read_description(folder() / "series" / "IM_0003.dcm"), words);
  fs::create_directory(folder() / "copied");
  write_volume<std::int16_t>(folder() / "copied" / "scan.nii.gz", ct.view(), words);
  EXPECT_EQ(read_description(folder() / "copied"), words);
}

TEST_F(ReadVolume, GivesTheSameGridWhicheverWayRoundAFileStoresIt) {
  const Grid<std::int16_t> ct = test_ct(Mat3::identity());
  const GridGeometry& g = ct.geometry();
  GridGeometry turned;  // slices first, rows reversed
  turned.size = {g.size[2], g.size[0], g.size[1]};
  turned.spacing = {g.spacing.z, g.spacing.x, g.spacing.y};
  turned.origin = g.patient_from_voxel({0, static_cast<double>(g.size[1] - 1), 0});
  turned.direction = Mat3::from_columns({0, 0, 1}, {1, 0, 0}, {0, -1, 0});
  Grid<std::int16_t> other(turned);
  for (int z = 0; z < g.size[2]; ++z)
    for (int y = 0; y < g.size[1]; ++y)
      for (int x = 0; x < g.size[0]; ++x)
        other[VoxelIndex{z, x, g.size[1] - 1 - y}] = ct[VoxelIndex{x, y, z}];
  write_volume<std::int16_t>(folder() / "turned.nrrd", other.view());
  expect_same_volume(read_ct(folder() / "turned.nrrd"), ct);
}

TEST_F(ReadVolume, AppliesSlopeAndInterceptOfADicomSeries) {
  Grid<std::int16_t> ct = test_ct(Mat3::identity());
  write_dicom_series(folder() / "twelve", ct.view(), {});  // intercept -1024
  EXPECT_THAT(bytes_of(folder() / "twelve" / "IM_0001.dcm"), HasSubstr("-1024"));
  expect_same_volume(read_ct(folder() / "twelve"), ct);
  ct[VoxelIndex{0, 0, 0}] = 12000;  // metal: 16 bits, signed
  write_dicom_series(folder() / "sixteen", ct.view(), {});
  expect_same_volume(read_ct(folder() / "sixteen"), ct);
}

TEST_F(ReadVolume, DecodesTheTransferSyntaxesOfScanners) {
  if (std::system("gdcmconv --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no gdcmconv; install libgdcm-tools";
  }
  const Grid<std::int16_t> ct = test_ct(oblique_direction());
  write_dicom_series(folder() / "plain", ct.view(), {});
  for (const char* syntax : {"--jpeg", "--jpegls", "--j2k", "--rle", "--implicit", "--deflated"}) {
    const fs::path converted = folder() / syntax;
    fs::create_directory(converted);
    for (const auto& entry : fs::directory_iterator(folder() / "plain")) {
      const std::string command = std::string("gdcmconv ") + syntax + " '" + entry.path().string() +
                                  "' '" + (converted / entry.path().filename()).string() + "'";
      ASSERT_EQ(std::system(command.c_str()), 0) << command;
    }
    SCOPED_TRACE(syntax);
    expect_same_volume(read_ct(converted), ct);
  }
}

TEST_F(ReadVolume, SaysWhatItTookByConvention) {
  const auto said_of = [](const fs::path& input) {
    std::string words;
    ReadOptions options;
    options.note = [&](const std::string& text) { words += text + "|"; };
    (void)read_ct(input, options);
    return words;
  };
  const Grid<std::int16_t> ct = test_ct(Mat3::identity());
  write_dicom_series(folder() / "s", ct.view(), {});
  EXPECT_EQ(said_of(folder() / "s"),
            "values are stored x 1 + -1024 (RescaleSlope, RescaleIntercept)|");
  fs::rename(folder() / "s" / "IM_0012.dcm", folder() / "s" / "IM_0000.dcm");
  EXPECT_THAT(said_of(folder() / "s"), HasSubstr("12 slices were sorted by their place"));
  write_volume<float>(folder() / "v.nrrd", Grid<float>(ct.geometry(), 40.4F).view());
  EXPECT_EQ(said_of(folder() / "v.nrrd"), "4284 voxels were rounded to whole HU|");
  GridGeometry turned = ct.geometry();
  turned.direction = Mat3::from_columns({-1, 0, 0}, {0, -1, 0}, {0, 0, 1});
  write_volume<std::int16_t>(folder() / "t.nii", Grid<std::int16_t>(turned).view());
  EXPECT_THAT(said_of(folder() / "t.nii"), HasSubstr("left, posterior, superior"));
}

TEST_F(ReadVolume, ReportsProgressInOrder) {
  write_dicom_series(folder() / "s", test_ct(Mat3::identity()).view(), {});
  std::vector<double> seen;
  ReadOptions options;
  options.progress = [&](std::string_view, double fraction) { seen.push_back(fraction); };
  (void)read_ct(folder() / "s", options);
  ASSERT_GE(seen.size(), 12U);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0);
}

TEST_F(ReadVolume, FindsASeriesInSubfoldersAndPassesOverOtherFiles) {
  const Grid<std::int16_t> ct = test_ct(Mat3::identity());
  fs::create_directories(folder() / "a" / "b");
  write_dicom_series(folder() / "a" / "b" / "c", ct.view(), {});
  std::ofstream(folder() / "a" / "notes.txt") << "DICM is mentioned here, but this is a note";
  expect_same_volume(read_ct(folder()), ct);
}

TEST_F(ReadVolume, SaysWhatToDoAboutAMissingOrEmptyFolder) {
  EXPECT_THAT(error_of<IoError>(folder() / "none"), HasSubstr("does not exist"));
  EXPECT_THAT(error_of<IoError>(folder()), HasSubstr("empty folder"));
  std::ofstream(folder() / "readme.txt") << "no image";
  EXPECT_THAT(error_of<InvalidInput>(folder()), HasSubstr("holds no image"));
  EXPECT_THAT(error_of<InvalidInput>(folder() / "readme.txt"), HasSubstr("none of the formats"));
}

TEST_F(ReadVolume, NamesATruncatedSlice) {
  write_dicom_series(folder() / "s", test_ct(Mat3::identity()).view(), {});
  for (const double ratio : {0.95, 0.7, 0.3}) {
    truncate_to(folder() / "s" / "IM_0005.dcm", ratio);
    EXPECT_THAT(error_of<IoError>(folder() / "s"),
                testing::AllOf(HasSubstr("IM_0005.dcm"), HasSubstr("copy")))
        << ratio;
  }
}

TEST_F(ReadVolume, NamesASliceThatLostItsMark) {
  write_dicom_series(folder() / "s", test_ct(Mat3::identity()).view(), {});
  const fs::path first = folder() / "s" / "IM_0001.dcm";
  const std::string whole = bytes_of(first);
  std::ofstream(first, std::ios::binary) << whole.substr(0, 100);
  EXPECT_THAT(error_of<IoError>(folder() / "s"),
              testing::AllOf(HasSubstr("IM_0001.dcm"), HasSubstr("cut short")));
  std::ofstream(first, std::ios::binary) << "";
  EXPECT_THAT(error_of<IoError>(folder() / "s"),
              testing::AllOf(HasSubstr("IM_0001.dcm"), HasSubstr("is empty")));
  std::ofstream(first, std::ios::binary) << whole;
  std::ofstream(folder() / "s" / "notes.txt") << "of the scan";
  EXPECT_NO_THROW((void)read_ct(folder() / "s"));
}

TEST_F(ReadVolume, RefusesADamagedDicomHeader) {
  write_dicom_series(folder() / "s", test_ct(Mat3::identity()).view(), {});
  const fs::path slice = folder() / "s" / "IM_0005.dcm";
  const std::string whole = bytes_of(slice);
  // The value representation of the transfer syntax, of a date, and the samples per pixel.
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{{"\x02\0\x10\0UI", 6}, {"\x02\0\x10\0XX", 6}},
        {{"\x08\0\x20\0DA", 6}, {"\x08\0\x20\0Da", 6}},
        {{"\x28\0\x02\0US\x02\0\x01", 9}, {"\x28\0\x02\0US\x02\0\x07", 9}}}) {
    std::ofstream(slice, std::ios::binary) << whole;
    patch(slice, from, to);
    EXPECT_THAT(error_of<IoError>(folder() / "s"),
                testing::AllOf(HasSubstr("IM_0005.dcm"), HasSubstr("damaged")));
  }
}

TEST_F(ReadVolume, NamesTheGapOfAMissingSlice) {
  write_dicom_series(folder() / "s", test_ct(Mat3::identity()).view(), {});
  fs::remove(folder() / "s" / "IM_0007.dcm");
  EXPECT_THAT(error_of<InvalidInput>(folder() / "s"),
              testing::AllOf(HasSubstr("IM_0006.dcm"), HasSubstr("IM_0008.dcm"),
                             HasSubstr("1 slice(s) missing")));
}

TEST_F(ReadVolume, RefusesUnevenSpacingAndDoubledSlices) {
  write_dicom_series(folder() / "s", test_ct(Mat3::identity()).view(), {});
  patch(folder() / "s" / "IM_0012.dcm", "\\108.375", "\\108.175");
  EXPECT_THAT(error_of<InvalidInput>(folder() / "s"), HasSubstr("uneven"));
  fs::copy_file(folder() / "s" / "IM_0003.dcm", folder() / "s" / "copy.dcm");
  EXPECT_THAT(error_of<InvalidInput>(folder() / "s"), HasSubstr("same slice twice"));
}

/// Slices of `count`, each as far beside the one before as `aside` says, written one by one; a
/// value is 10 x - 7 y + 3 z of its place.
void write_slanted(const fs::path& folder, int count, const std::function<Vec3(int)>& aside) {
  fs::create_directories(folder / "all");
  for (int k = 0; k < count; ++k) {
    GridGeometry g = test_ct(Mat3::identity()).geometry();
    g.size[2] = 1;
    g.origin += aside(k) + Vec3{0, 0, 0.625 * k};
    Grid<std::int16_t> slice(g);
    // A series is named by its values: they come after, into the file's last bytes, where 0 HU are
    // stored as 1024.
    write_dicom_series(folder / "one", slice.view(), DicomDescription{});
    const fs::path file = folder / "all" / ("t" + std::to_string(100 + k) + ".dcm");
    fs::rename(folder / "one" / "IM_0001.dcm", file);
    for (std::size_t i = 0; i < g.voxel_count(); ++i) {
      const VoxelIndex v = g.index_of(i);
      const Vec3 p = g.patient_from_voxel({static_cast<double>(v.x), static_cast<double>(v.y), 0});
      slice[i] = static_cast<std::int16_t>(1024 + std::lround(10 * p.x - 7 * p.y + 3 * p.z));
    }
    const std::size_t bytes = slice.values().size_bytes();
    std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
    out.seekp(-static_cast<std::streamoff>(bytes + bytes % 2), std::ios::end);
    out.write(reinterpret_cast<const char*>(slice.values().data()),
              static_cast<std::streamsize>(bytes));
  }
}

TEST_F(ReadVolume, SetsTheSlicesOfATiltedGantryUpright) {
  for (const double tilt_mm : {0.1, -0.25}) {
    SCOPED_TRACE(tilt_mm);
    write_slanted(folder(), 12, [&](int k) { return Vec3{-0.04 * k, tilt_mm * k, 0}; });
    const Grid<std::int16_t> ct = read_ct(folder() / "all");
    const GridGeometry& g = ct.geometry();
    EXPECT_EQ(g.size[0], 21 + 2);
    EXPECT_EQ(g.size[1], 17 + static_cast<int>(std::ceil(std::abs(tilt_mm) * 11 / 0.35)));
    const Vec3 first = test_ct(Mat3::identity()).geometry().origin;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < g.voxel_count(); ++i) {
      const VoxelIndex v = g.index_of(i);
      const Vec3 p = g.patient_from_voxel(
          {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
      const Vec3 in_slice = p - first - Vec3{-0.04 * v.z, tilt_mm * v.z, 0.625 * v.z};
      const bool is_inside =
          in_slice.x > 0 && in_slice.x < 20 * 0.3 && in_slice.y > 0 && in_slice.y < 16 * 0.35;
      if (!is_inside) continue;
      ++inside;
      EXPECT_NEAR(ct[i], 10 * p.x - 7 * p.y + 3 * p.z, 1.01);
    }
    EXPECT_GT(inside, 12U * 19 * 15);
    fs::remove_all(folder() / "all");
  }
}

TEST_F(ReadVolume, RefusesSlicesShiftedUnevenlyOrTooFar) {
  write_slanted(folder(), 12, [](int k) { return Vec3{0, k > 5 ? 0.4 : 0.0, 0}; });
  EXPECT_THAT(error_of<InvalidInput>(folder() / "all"), HasSubstr("less evenly"));
  fs::remove_all(folder() / "all");
  write_slanted(folder(), 12, [](int k) { return Vec3{0, 0.5 * k, 0}; });
  EXPECT_THAT(error_of<InvalidInput>(folder() / "all"), HasSubstr("shifted sideways"));
}

TEST_F(ReadVolume, ListsTwoSeriesAndTakesTheOneChosen) {
  const Grid<std::int16_t> ct = test_ct(Mat3::identity());
  DicomDescription bone;
  bone.series_description = "bone kernel";
  DicomDescription soft;
  soft.series_description = "soft kernel";
  soft.seed = 1;
  write_dicom_series(folder() / "one", ct.view(), bone);
  write_dicom_series(folder() / "two", test_ct(Mat3::identity(), 10).view(), soft);
  const std::string message = error_of<InvalidInput>(folder());
  EXPECT_THAT(message, testing::AllOf(HasSubstr("2 series"), HasSubstr("bone kernel"),
                                      HasSubstr("10 slices")));
  ReadOptions options;
  const std::string uid_follows = "    --series ";  // the series with most slices comes first
  const std::size_t uid_at = message.find(uid_follows) + uid_follows.size();
  options.series_uid = message.substr(uid_at, message.find('\n', uid_at) - uid_at);
  expect_same_volume(read_ct(folder(), options), ct);
  EXPECT_EQ(read_description(folder(), options.series_uid), "bone kernel");
  options.series_uid = "1.2.3";
  EXPECT_THAT(error_of<InvalidInput>(folder(), options), HasSubstr("holds no series 1.2.3"));
}

TEST_F(ReadVolume, PassesOverAScout) {
  const Grid<std::int16_t> ct = test_ct(Mat3::identity());
  DicomDescription scout;
  scout.seed = 9;
  write_dicom_series(folder() / "scan", ct.view(), {});
  write_dicom_series(folder() / "scout", test_ct(Mat3::identity(), 1).view(), scout);
  std::string warning;
  ReadOptions options;
  options.warn = [&](const std::string& words) { warning = words; };
  expect_same_volume(read_ct(folder(), options), ct);
  EXPECT_THAT(warning, HasSubstr("passed over"));
}

TEST_F(ReadVolume, RefusesDamagedVolumeFiles) {
  const Grid<std::int16_t> ct = test_ct(Mat3::identity());
  for (const char* name : {"a.nii", "b.nii.gz", "c.nrrd", "d.mha"}) {
    SCOPED_TRACE(name);
    write_volume<std::int16_t>(folder() / name, ct.view());
    truncate_to(folder() / name, 0.6);
    EXPECT_THAT(error_of<IoError>(folder() / name),
                testing::AllOf(HasSubstr(name), HasSubstr("copy it again")));
    std::ofstream(folder() / name) << "this is not an image";
    EXPECT_THAT(error_of<IoError>(folder() / name), HasSubstr(name));
  }
}

TEST_F(ReadVolume, RefusesImpossibleGeometry) {
  write_volume<std::int16_t>(folder() / "v.mha", test_ct(Mat3::identity()).view());
  patch(folder() / "v.mha", "ElementSpacing = 0.29999999999999999",
        "ElementSpacing = 0.00000000000000000");
  EXPECT_THAT(error_of<InvalidInput>(folder() / "v.mha"), HasSubstr("spacing 0 mm on axis 0"));
  std::ofstream(folder() / "huge.nrrd")
      << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
         "sizes: 60000 60000 60000\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
         "endian: little\nencoding: raw\n\nxx";
  EXPECT_THAT(error_of<InvalidInput>(folder() / "huge.nrrd"), HasSubstr("crop it"));
  std::ofstream(folder() / "shear.nrrd")
      << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
         "sizes: 2 2 2\nspace directions: (1,0,0) (0,1,0) (0,0.3,1)\n"
         "endian: little\nencoding: raw\n\n0123456789012345";
  EXPECT_THAT(error_of<InvalidInput>(folder() / "shear.nrrd"), HasSubstr("right angles"));
}

TEST_F(ReadVolume, RefusesNiftiGeometryThatIsNoNumber) {
  GridGeometry g;
  g.size = {8, 8, 8};
  g.spacing = {1, 1, 1};
  const Grid<std::int16_t> ct(g);
  const std::filesystem::path file = folder() / "v.nii";
  const float no_number = std::numeric_limits<float>::quiet_NaN();
  for (const std::streamoff at :
       {80, 268, 280, 292}) {  // pixdim[1], qoffset_x, srow_x[0], srow_x[3]
    write_volume<std::int16_t>(file, ct.view());
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(252);
    const std::array<std::int16_t, 2> both_forms{1, 1};
    stream.write(reinterpret_cast<const char*>(both_forms.data()), sizeof both_forms);
    stream.seekp(at);
    stream.write(reinterpret_cast<const char*>(&no_number), sizeof no_number);
    stream.close();
    EXPECT_THAT(error_of<IoError>(file), HasSubstr("is no number")) << at;
  }
}

TEST_F(ReadVolume, RefusesNotFiniteValuesAndWarnsOfOthersThanHu) {
  const GridGeometry g = test_ct(Mat3::identity()).geometry();
  Grid<float> values(g, 40.0F);
  values[VoxelIndex{1, 2, 3}] = std::numeric_limits<float>::quiet_NaN();
  write_volume<float>(folder() / "v.mha", Grid<float>(g, 40.0F).view());
  std::string bytes = bytes_of(folder() / "v.mha");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  bytes.replace(bytes.size() - sizeof nan, sizeof nan,
                std::string(reinterpret_cast<const char*>(&nan), sizeof nan));
  std::ofstream(folder() / "v.mha", std::ios::binary) << bytes;
  EXPECT_THAT(error_of<InvalidInput>(folder() / "v.mha"), HasSubstr("1 voxels are not numbers"));

  std::string warning;
  ReadOptions options;
  options.warn = [&](const std::string& words) { warning = words; };
  write_volume<float>(folder() / "flat.nrrd", Grid<float>(g, 40.4F).view());
  EXPECT_EQ(read_ct(folder() / "flat.nrrd", options)[0], 40);
  EXPECT_THAT(warning, HasSubstr("shows no bone"));
  write_volume<float>(folder() / "shifted.nrrd", Grid<float>(g, 1400.0F).view());
  (void)read_ct(folder() / "shifted.nrrd", options);
  EXPECT_THAT(warning, HasSubstr("rescale intercept"));
}

TEST_F(ReadVolume, LabelsAreWholeNumbersUpTo255) {
  const GridGeometry g = test_ct(Mat3::identity()).geometry();
  Grid<std::uint8_t> labels(g);
  labels[VoxelIndex{3, 2, 1}] = kFractureGapLabel;
  write_volume<std::uint8_t>(folder() / "labels.nii.gz", labels.view());
  EXPECT_EQ((read_labels(folder() / "labels.nii.gz")[VoxelIndex{3, 2, 1}]), kFractureGapLabel);
  write_volume<float>(folder() / "v.nrrd", Grid<float>(g, 2.5F).view());
  EXPECT_THROW((void)read_labels(folder() / "v.nrrd"), InvalidInput);
  write_volume<std::int16_t>(folder() / "w.nrrd", Grid<std::int16_t>(g, 300).view());
  EXPECT_THROW((void)read_labels(folder() / "w.nrrd"), InvalidInput);
}

TEST_F(ReadVolume, TheSameSeedGivesTheSameSeries) {
  const Grid<std::int16_t> ct = test_ct(Mat3::identity());
  write_dicom_series(folder() / "a", ct.view(), {});
  write_dicom_series(folder() / "b", ct.view(), {});
  EXPECT_EQ(bytes_of(folder() / "a" / "IM_0004.dcm"), bytes_of(folder() / "b" / "IM_0004.dcm"));
  EXPECT_THROW(write_dicom_series(folder() / "a", ct.view(), {}), IoError);
}

}  // namespace
}  // namespace carpus::case_io

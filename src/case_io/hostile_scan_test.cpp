// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that lie about themselves, one by one: each is refused by its own name, fast, and without
// the memory that it claims.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>

#include "case_io/read_volume.hpp"
#include "case_io/write_volume.hpp"
#include "core/error.hpp"
#include "core/is_sanitized.hpp"
#include "core/rng.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using namespace std::string_literals;

Grid<std::int16_t> small_ct() {
  GridGeometry g;
  g.size = {21, 17, 12};
  g.spacing = {0.3, 0.35, 0.625};
  g.origin = {-45.75, 12.25, 101.5};
  Grid<std::int16_t> ct(g);
  Rng rng(5);
  for (auto& v : ct.values()) v = static_cast<std::int16_t>(rng.below(3000)) - 1000;
  return ct;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

template <typename T>
std::string raw(T value) {
  std::string s(sizeof value, '\0');
  std::memcpy(s.data(), &value, sizeof value);
  return s;
}

std::string zlib_packed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  packed.resize(size);
  return packed;
}

/// Whatever is said, it is said soon: not one of these files may take a second.
std::string refusal_of(const fs::path& input) {
  const auto began = std::chrono::steady_clock::now();
  std::string words = "no error";
  try {
    (void)read_ct(input);
  } catch (const Error& error) {
    words = error.what();
  }
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10)) << input;
  return words;
}

class HostileScan : public ::testing::Test {
 protected:
  HostileScan()
      : folder_(fs::temp_directory_path() /
                ("carpus_hostile_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~HostileScan() override { fs::remove_all(folder_); }
  [[nodiscard]] const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

/// A series of twelve slices, one of which is changed.
class HostileSeries : public HostileScan {
 protected:
  HostileSeries() {
    write_dicom_series(folder() / "s", small_ct().view(), {});
    whole_ = bytes_of(slice());
  }
  [[nodiscard]] fs::path series() const { return folder() / "s"; }
  [[nodiscard]] fs::path slice() const { return series() / "IM_0005.dcm"; }
  [[nodiscard]] const std::string& whole() const { return whole_; }

  /// What is said about the series when this slice is changed so.
  std::string refusal_with(const std::string& bytes) const {
    write(slice(), bytes);
    return refusal_of(series());
  }
  /// The slice with one text replaced by another.
  [[nodiscard]] std::string replaced(const std::string& from, const std::string& to) const {
    std::string bytes = whole_;
    const std::size_t at = bytes.find(from);
    EXPECT_NE(at, std::string::npos);
    return at == std::string::npos ? bytes : bytes.replace(at, from.size(), to);
  }
  [[nodiscard]] static std::string pixels_header(std::uint32_t length) {
    return "\xe0\x7f\x10\0OW\0\0"s + raw(length);
  }

 private:
  std::string whole_;
};

constexpr std::uint32_t kSliceBytes = 21 * 17 * 2;

TEST_F(HostileSeries, WithOneSlicesPixelsCutConsistently) {
  std::string cut = replaced(pixels_header(kSliceBytes), pixels_header(100));
  cut.resize(cut.size() - kSliceBytes + 100);
  EXPECT_THAT(refusal_with(cut), AllOf(HasSubstr("IM_0005.dcm: PixelData is 100 bytes"),
                                       HasSubstr("17 rows x 21 columns x 16 bits x 1 frames")));
}

TEST_F(HostileSeries, WithOtherRowsInEverySlice) {
  for (const auto& entry : fs::directory_iterator(series())) {
    std::string bytes = bytes_of(entry.path());
    const std::string rows = "\x28\0\x10\0US\x02\0"s;
    bytes.replace(bytes.find(rows) + rows.size(), 2, raw<std::uint16_t>(60000));
    write(entry.path(), bytes);
  }
  EXPECT_THAT(refusal_of(series()), HasSubstr("60000 rows x 21 columns"));
}

TEST_F(HostileSeries, WithBytesBehindASlice) {
  for (std::size_t count = 1; count < 20; ++count) {
    EXPECT_THAT(refusal_with(whole() + std::string(count, '\0')),
                AllOf(HasSubstr("IM_0005.dcm"), HasSubstr("damaged")))
        << count;
  }
}

TEST_F(HostileSeries, WithATailThatClaimsFourGigabytes) {
  EXPECT_THAT(refusal_with(whole() + "\xfc\xff\xfc\xffOB\0\0\xf0\xff\xff\xff"s),
              HasSubstr("IM_0005.dcm: is cut short: (fffc,fffc)"));
}

TEST_F(HostileSeries, WithPixelsOfAKindThatNoCtHas) {
  const std::string allocated = "\x28\0\x00\x01US\x02\0"s;
  for (const char bits : {'\x0c', '\x20'}) {
    std::string bytes = whole();
    bytes[bytes.find(allocated) + allocated.size()] = bits;
    EXPECT_THAT(refusal_with(bytes), HasSubstr("IM_0005.dcm")) << int{bits};
  }
  const std::string photometric = "\x28\0\x04\0CS\x0c\0MONOCHROME2 "s;
  EXPECT_THAT(refusal_with(replaced(photometric, "\x28\0\x04\0CS\x0e\0PALETTE COLOR "s)),
              AllOf(HasSubstr("IM_0005.dcm"), HasSubstr("PhotometricInterpretation"),
                    HasSubstr("PALETTE COLOR")));
  EXPECT_THAT(refusal_with(replaced("MONOCHROME2 ", "MONOCHROME1 ")), HasSubstr("MONOCHROME1"));
}

TEST_F(HostileSeries, WithSequencesInSequencesWithoutEnd) {
  const std::string sequence = "\xff\xff\xff\xff"s;
  std::string nest;
  for (int i = 0; i < 60000; ++i) {
    nest += "\x08\0\x15\x11SQ\0\0"s + sequence + "\xfe\xff\0\xe0"s + sequence;
  }
  const std::size_t before = whole().find("\x10\0\x10\0PN"s);
  ASSERT_NE(before, std::string::npos);
  std::string bytes = whole();
  EXPECT_THAT(refusal_with(bytes.insert(before, nest)),
              AllOf(HasSubstr("IM_0005.dcm"), HasSubstr("nesting")));
}

TEST_F(HostileSeries, WithBitsAboveThoseStored) {
  std::string bytes = whole();
  bytes[bytes.size() - 1] = '\x70';
  EXPECT_THAT(refusal_with(bytes), AllOf(HasSubstr("IM_0005.dcm"), HasSubstr("only 12 bits")));
}

TEST_F(HostileSeries, WithOneSlicesScalingUnlikeTheOthers) {
  EXPECT_THAT(refusal_with(replaced("DS\x06\0-1024 "s, "DS\x06\0-1000 "s)),
              AllOf(HasSubstr("IM_0005.dcm"), HasSubstr("RescaleIntercept")));
  EXPECT_THAT(refusal_with(replaced("\x53\x10\x44S\x02\0\x31 "s, "\x53\x10\x44S\x02\0\x30 "s)),
              AllOf(HasSubstr("IM_0005.dcm"), HasSubstr("RescaleSlope")));
}

TEST_F(HostileSeries, WithTheLastSliceInASeriesOfItsOwn) {
  std::string bytes = bytes_of(series() / "IM_0012.dcm");
  const std::string tag = "\x20\0\x0e\0UI"s;
  const std::size_t at = bytes.find(tag) + tag.size() + 2 + 10;
  bytes[at] = bytes[at] == '1' ? '2' : '1';
  write(series() / "IM_0012.dcm", bytes);
  EXPECT_THAT(refusal_of(series()),
              AllOf(HasSubstr("IM_0012.dcm"), HasSubstr("SeriesInstanceUID")));
}

TEST_F(HostileSeries, WhoseLastSliceEndsBetweenTwoElements) {
  const std::string bytes = bytes_of(series() / "IM_0012.dcm");
  for (const std::string& tag : {"\x28\0\x02\0US"s, "\x20\0\x0e\0UI"s, "\x08\0\x16\0UI"s}) {
    write(series() / "IM_0012.dcm", bytes.substr(0, bytes.find(tag)));
    EXPECT_THAT(refusal_of(series()), AllOf(HasSubstr("IM_0012.dcm"), HasSubstr("cut short")));
  }
}

TEST_F(HostileSeries, ThatUnpacksToFarMoreThanASlice) {
  std::string packed(std::size_t{1} << 23U, '\0');
  z_stream stream{};
  deflateInit2(&stream, 1, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY);
  std::string zeros(std::size_t{1} << 20U, '\0');
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  for (int i = 0; i < 270; ++i) {
    stream.next_in = reinterpret_cast<Bytef*>(zeros.data());
    stream.avail_in = static_cast<uInt>(zeros.size());
    deflate(&stream, i == 269 ? Z_FINISH : Z_NO_FLUSH);
  }
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  const std::string syntax =
      "\x02\0\x10\0UI\x14\0"
      "1.2.840.10008.1.2.1\0"s;
  const std::string deflated =
      "\x02\0\x10\0UI\x16\0"
      "1.2.840.10008.1.2.1.99"s;
  std::string bytes = replaced(syntax, deflated);
  const std::size_t data = bytes.find("\x08\0\x05\0"s);
  bytes.resize(data);
  EXPECT_THAT(refusal_with(bytes + packed),
              AllOf(HasSubstr("IM_0005.dcm"), HasSubstr("deflated data set")));
}

TEST_F(HostileSeries, WhoseWordsWouldCommandATerminal) {
  DicomDescription other;
  other.series_description = "\x1b]0;owned\x07 \x1b[2J";
  other.seed = 7;
  write_dicom_series(folder() / "t", small_ct().view(), other);
  const std::string words = refusal_of(folder());
  EXPECT_THAT(words, AllOf(HasSubstr("2 series"), HasSubstr("?]0;owned?")));
  EXPECT_EQ(words.find('\x1b'), std::string::npos);
}

TEST_F(HostileSeries, WithAPipeAmongItsFilesIsStillRead) {
  ASSERT_EQ(::mkfifo((series() / "IM_0099.dcm").c_str(), 0600), 0);
  EXPECT_EQ(refusal_of(series()), "no error");
}

TEST_F(HostileScan, ThatIsADeviceOrAPipeIsRefusedAtOnce) {
  for (const char* name : {"ct.nii", "ct.nrrd", "ct.mha", "ct.dcm"}) {
    const fs::path file = folder() / name;
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    EXPECT_THAT(refusal_of(file), AllOf(HasSubstr(name), HasSubstr("no regular file")));
    fs::remove(file);
    fs::create_symlink("/dev/zero", file);
    EXPECT_THAT(refusal_of(file), AllOf(HasSubstr(name), HasSubstr("no regular file")));
    fs::remove(file);
  }
}

class HostileNifti : public HostileScan {
 protected:
  HostileNifti() { write_volume<std::int16_t>(file(), small_ct().view()); }
  [[nodiscard]] fs::path file() const { return folder() / "v.nii"; }
  std::string refusal_with(std::size_t at, const std::string& value) const {
    std::string bytes = bytes_of(file());
    write(folder() / "changed.nii", bytes.replace(at, value.size(), value));
    return refusal_of(folder() / "changed.nii");
  }
};

TEST_F(HostileNifti, WithVoxelsThatAreNoNumbers) {
  const Grid<std::int16_t> ct = small_ct();
  Grid<float> values(ct.geometry(), 40.0F);
  write_volume<float>(folder() / "f.nii", values.view());
  std::string bytes = bytes_of(folder() / "f.nii");
  write(folder() / "f.nii",
        bytes.replace(bytes.size() - 4, 4, raw(std::numeric_limits<float>::quiet_NaN())));
  EXPECT_THAT(refusal_of(folder() / "f.nii"), HasSubstr("1 voxels are not numbers"));
}

TEST_F(HostileNifti, WhoseSpacingIsSaidTwiceAndDiffers) {
  EXPECT_THAT(refusal_with(80, raw(0.33F)),
              AllOf(HasSubstr("pixdim[1] is 0.33 mm"), HasSubstr("sform says 0.3")));
  EXPECT_THAT(refusal_with(268, raw(45.0F)), HasSubstr("qform"));    // qoffset_x
  EXPECT_THAT(refusal_with(256, raw(0.05F)), HasSubstr("quatern"));  // _b
  EXPECT_THAT(refusal_with(292, raw(40.0F)), HasSubstr("qform"));    // srow_x[3]
}

TEST_F(HostileNifti, ThatDoesNotSayWhereLeftIs) {
  EXPECT_THAT(refusal_with(252, raw(std::int16_t{0}) + raw(std::int16_t{0})),
              HasSubstr("left and right are not known"));
  EXPECT_EQ(refusal_with(252, raw(std::int16_t{1}) + raw(std::int16_t{0})), "no error");
  EXPECT_EQ(refusal_with(252, raw(std::int16_t{0}) + raw(std::int16_t{1})), "no error");
}

TEST_F(HostileNifti, OfAnotherLengthThanItsHeaderSays) {
  const std::string bytes = bytes_of(file());
  for (const std::string& other : {bytes + "x", bytes.substr(0, bytes.size() - 1)}) {
    write(file(), other);
    EXPECT_THAT(refusal_of(file()), HasSubstr("its voxel data"));
  }
  write(file(), bytes);
  fs::resize_file(file(), std::uintmax_t{40} << 30U);  // sparse: nothing of it on the disk
  EXPECT_THAT(refusal_of(file()), HasSubstr("its voxel data"));
}

TEST_F(HostileNifti, PackedAndDamagedAnywhere) {
  const fs::path packed = folder() / "v.nii.gz";
  write_volume<std::int16_t>(packed, small_ct().view());
  const std::string bytes = bytes_of(packed);
  for (std::size_t at = 0; at < bytes.size(); at += 97) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    write(packed, changed);
    // Gzip's own header holds a time and flags that mean nothing.
    if (at < 10) continue;
    EXPECT_NE(refusal_of(packed), "no error") << at;
  }
  for (const std::string& other : {bytes + "x", bytes + bytes, bytes + std::string(100, '\0'),
                                   bytes.substr(0, bytes.size() - 1)}) {
    write(packed, other);
    EXPECT_THAT(refusal_of(packed), HasSubstr("damaged"));
  }
  write(packed, bytes);
  fs::resize_file(packed, std::uintmax_t{40} << 30U);
  EXPECT_THAT(refusal_of(packed), HasSubstr("its compressed data"));
}

TEST_F(HostileNifti, ThatClaimsMoreThanItsBytesCanUnpackTo) {
  std::string header = bytes_of(file()).substr(0, 352);
  for (std::size_t i = 0; i < 3; ++i) header.replace(42 + 2 * i, 2, raw(std::int16_t{1000}));
  gzFile out = gzopen((folder() / "big.nii.gz").c_str(), "wb");
  gzwrite(out, header.data(), static_cast<unsigned>(header.size()));
  const std::string zeros(1 << 20, '\0');
  for (int i = 0; i < 64; ++i) gzwrite(out, zeros.data(), 1 << 20);
  gzclose(out);
  EXPECT_THAT(refusal_of(folder() / "big.nii.gz"),
              AllOf(HasSubstr("its compressed data"), HasSubstr("2000000352")));
  for (std::size_t i = 0; i < 3; ++i) header.replace(42 + 2 * i, 2, raw(std::int16_t{32767}));
  write(folder() / "huge.nii", header);
  EXPECT_THAT(refusal_of(folder() / "huge.nii"), HasSubstr("crop it"));
}

TEST_F(HostileNifti, ThatNeedsMoreMemoryThanThereIs) {
  if (kIsSanitized) GTEST_SKIP() << "sanitizers map terabytes";
  std::string header = bytes_of(file()).substr(0, 352);
  for (std::size_t i = 0; i < 3; ++i) header.replace(42 + 2 * i, 2, raw(std::int16_t{1000}));
  write(folder() / "big.nii", header);
  fs::resize_file(folder() / "big.nii", 352 + std::uintmax_t{2000000000});  // sparse
  rlimit before{};
  ::getrlimit(RLIMIT_AS, &before);
  rlimit small = before;
  small.rlim_cur = rlim_t{1} << 30U;
  ::setrlimit(RLIMIT_AS, &small);
  const std::string words = refusal_of(folder() / "big.nii");
  ::setrlimit(RLIMIT_AS, &before);
  EXPECT_THAT(words, AllOf(HasSubstr("big.nii: needs 2067 MB"), HasSubstr("MB are free")));
}

std::string nrrd_header(const std::string& more) {
  return "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 8 8 8\n"
         "space directions: (1,0,0) (0,1,0) (0,0,1)\nendian: little\n" +
         more + "\n\n";
}

TEST_F(HostileScan, NrrdThatUnpacksToAnotherLength) {
  const auto packed = [&](std::size_t size) {
    const fs::path file = folder() / "packed.gz";
    gzFile out = gzopen(file.c_str(), "wb9");
    const std::string zeros(1 << 20, '\0');
    for (; size > 0; size -= std::min<std::size_t>(size, 1 << 20)) {
      gzwrite(out, zeros.data(), static_cast<unsigned>(std::min<std::size_t>(size, 1 << 20)));
    }
    gzclose(out);
    return bytes_of(file);
  };
  const fs::path file = folder() / "v.nrrd";
  write(file, nrrd_header("encoding: gzip") + packed(1024));
  EXPECT_EQ(refusal_of(file), "no error");
  for (const std::size_t size : {std::size_t{1023}, std::size_t{1025}, std::size_t{150} << 20U}) {
    write(file, nrrd_header("encoding: gzip") + packed(size));
    EXPECT_THAT(refusal_of(file), HasSubstr("its compressed data")) << size;
  }
  const fs::path odd = folder() / "odd.gz";  // of zeros, some damage unpacks to the same
  gzFile out = gzopen(odd.c_str(), "wb");
  for (std::uint16_t i = 0; i < 512; ++i) gzwrite(out, &i, sizeof i);
  gzclose(out);
  const std::string header = nrrd_header("encoding: gzip");
  const std::string bytes = header + bytes_of(odd);
  const std::size_t begins = header.size();
  for (std::size_t at = begins + 10; at < bytes.size(); at += 11) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    write(file, changed);
    EXPECT_NE(refusal_of(file), "no error") << at - begins;
  }
}

std::string meta_header(const std::string& data, const std::string& more = "") {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" +
         more +
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 1 1 1\n"
         "DimSize = 8 8 8\nElementType = MET_SHORT\nElementDataFile = " +
         data + "\n";
}

TEST_F(HostileScan, MetaImageWhoseHeaderOverranItsReader) {
  const std::string voxels(1024, '\0');
  const fs::path file = folder() / "v.mha";
  write(file, meta_header("LOCAL") + voxels);
  EXPECT_EQ(refusal_of(file), "no error");
  for (const std::string name :
       {"%", "%s%s%s%n", "slice%03d.raw 1 8 1", "LIST", "LIST 2", "list"}) {
    write(file, meta_header(name) + voxels);
    EXPECT_THAT(refusal_of(file), HasSubstr("ElementDataFile")) << name;
  }
  write(file, meta_header("LOCAL", std::string(300, 'K') + " = 1\n") + voxels);
  EXPECT_EQ(refusal_of(file), "no error");  // a remark like any other
  std::string bytes = meta_header("LOCAL") + voxels;
  for (const char* dimensions : {"-1", "0", "11", "3 3", "99999999999999999999", ""}) {
    std::string changed = bytes;
    write(file,
          changed.replace(changed.find("NDims = 3"), 9, std::string("NDims = ") + dimensions));
    EXPECT_THAT(refusal_of(file), HasSubstr("NDims")) << dimensions;
  }
}

TEST_F(HostileScan, PackedMetaImageDamagedAnywhere) {
  std::string voxels;
  Rng rng(3);
  for (int i = 0; i < 512; ++i) voxels += raw(static_cast<std::int16_t>(rng.below(500)));
  const std::string packed = zlib_packed(voxels);
  const std::string header = meta_header("LOCAL", "CompressedData = True\n");
  const fs::path file = folder() / "v.mha";
  write(file, header + packed);
  EXPECT_EQ(refusal_of(file), "no error");
  for (std::size_t at = 0; at < packed.size(); at += 7) {
    std::string changed = packed;
    changed[at] = static_cast<char>(changed[at] ^ 16);
    write(file, header + changed);
    EXPECT_NE(refusal_of(file), "no error") << at;
  }
  for (const std::string& other :
       {packed.substr(0, packed.size() / 2), packed + "x", packed + packed,
        zlib_packed(voxels + "x"), zlib_packed(voxels.substr(1))}) {
    write(file, header + other);
    EXPECT_THAT(refusal_of(file), HasSubstr("damaged"));
  }
}

TEST_F(HostileScan, HeadersThatNameAFileOutsideTheirFolder) {
  const std::string voxels(1024, '\0');
  write(folder() / "secret.raw", voxels);
  fs::create_directory(folder() / "in");
  write(folder() / "in" / "beside.raw", voxels);
  fs::create_symlink(folder() / "secret.raw", folder() / "in" / "link.raw");
  ASSERT_EQ(::mkfifo((folder() / "in" / "pipe.raw").c_str(), 0600), 0);
  const auto with = [&](const std::string& name) {
    write(folder() / "in" / "v.mhd", meta_header(name));
    write(folder() / "in" / "v.nhdr",
          nrrd_header("encoding: raw\ndata file: " + name).substr(0, std::string::npos));
    return refusal_of(folder() / "in" / "v.mhd") + "|" + refusal_of(folder() / "in" / "v.nhdr");
  };
  EXPECT_EQ(with("beside.raw"), "no error|no error");
  for (const std::string& name :
       {"../secret.raw"s, (folder() / "secret.raw").string(), "/etc/passwd"s, "./../secret.raw"s,
        "link.raw"s, "pipe.raw"s, "/dev/zero"s, "in/../../secret.raw"s, "gone.raw"s, "."s, ".."s}) {
    EXPECT_THAT(with(name), testing::Not(HasSubstr("no error"))) << name;
  }
}

}  // namespace
}  // namespace carpus::case_io

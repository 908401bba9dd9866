// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every file that fuzzing started from or once crashed on (fuzz/corpus): accepted or refused in
// words. What the seeds' names promise is checked, so that the corpus stays what it is called.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <string>

#include "core/error.hpp"
#include "image_formats/codestream_header.hpp"
#include "image_formats/dicom_header.hpp"
#include "image_formats/meta_image_header.hpp"
#include "image_formats/nifti_header.hpp"
#include "image_formats/nrrd_header.hpp"
#include "image_formats/rle_frame.hpp"

namespace carpus::image_formats {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void read_dicom(const std::string& content, const Refuser& refuse) {
  const auto bytes = std::as_bytes(std::span(content));
  MemoryBytes source(bytes);
  if (!has_dicom_mark(source)) refuse.damaged("its mark", "missing", "DICM is needed");
  const DicomFront front = parse_dicom_front(source, refuse);
  const DicomHeader header = parse_dicom(source, front.data_begins, front.syntax, refuse);
  if (header.is_image) check_readable(header, refuse);
}

/// The files of a folder that are accepted.
std::set<std::string> accepted_in(
    const char* folder,
    const std::function<void(const std::string&, const Refuser&)>& parse) {
  std::set<std::string> accepted;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path("fuzz/corpus") / folder)) {
    ++files;
    try {
      parse(bytes_of(entry.path()), Refuser(entry.path().string()));
      accepted.insert(entry.path().filename().string());
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(entry.path().string())) << error.what();
    }
  }
  EXPECT_GT(files, 5U) << folder;
  return accepted;
}

TEST(Corpus, IsAcceptedOrRefusedInWords) {
  EXPECT_EQ(
      accepted_in("nifti",
                  [](const std::string& b, const Refuser& r) {
                    (void)parse_nifti(std::as_bytes(std::span(b)), r);
                  }),
      (std::set<std::string>{"both_forms", "big_endian", "qform_only", "sform_only_float_scaled"}));
  EXPECT_EQ(
      accepted_in("nrrd", [](const std::string& b, const Refuser& r) { (void)parse_nrrd(b, r); }),
      (std::set<std::string>{"raw", "gzip", "beside", "ras_with_spacings"}));
  EXPECT_EQ(accepted_in("meta_image", [](const std::string& b,
                                         const Refuser& r) { (void)parse_meta_image(b, r); }),
            (std::set<std::string>{"raw", "packed", "beside", "long_key"}));
  EXPECT_EQ(accepted_in("dicom", read_dicom),
            (std::set<std::string>{"explicit", "implicit", "big_endian", "eight_bits", "rle",
                                   "jpeg", "jpegls", "j2k", "enhanced", "unknown_sequence"}));
}

TEST(Corpus, EnhancedDicomPlacesEachOfItsFrames) {
  const std::string content = bytes_of("fuzz/corpus/dicom/enhanced");
  MemoryBytes source(std::as_bytes(std::span(content)));
  const Refuser refuse("enhanced");
  const DicomFront front = parse_dicom_front(source, refuse);
  const DicomHeader header = parse_dicom(source, front.data_begins, front.syntax, refuse);
  ASSERT_EQ(header.frames.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const DicomFrame& frame = header.frames[i];
    EXPECT_TRUE(frame.has_place);
    EXPECT_EQ(frame.position, (Vec3{0, 0, static_cast<double>(i)}));
    EXPECT_EQ(frame.row, (Vec3{1, 0, 0}));
    EXPECT_EQ(frame.spacing, (Vec3{0.3, 0.35, 0}));
    EXPECT_EQ(frame.intercept, -1024);
  }
}

TEST(Corpus, CompressedFramesSayTheirOwnSize) {
  for (const char* name : {"jpeg", "jpegls", "j2k"}) {
    const std::string content = bytes_of(fs::path("fuzz/corpus/dicom") / name);
    const auto bytes = std::as_bytes(std::span(content));
    MemoryBytes source(bytes);
    const Refuser refuse(name);
    const DicomFront front = parse_dicom_front(source, refuse);
    DicomHeader header = parse_dicom(source, front.data_begins, front.syntax, refuse);
    ASSERT_EQ(header.pixels.size(), 1U) << name;
    std::vector<std::byte> frame;
    for (const ByteRange& piece : header.pixels[0]) {
      const auto part = bytes.subspan(piece.begins, piece.bytes);
      frame.insert(frame.end(), part.begin(), part.end());
    }
    EXPECT_NO_THROW(check_codestream(frame, header, refuse)) << name;
    ++header.rows;
    EXPECT_THROW(check_codestream(frame, header, refuse), IoError) << name;
    --header.rows;
    frame.pop_back();  // its end
    frame.pop_back();
    EXPECT_THROW(check_codestream(frame, header, refuse), IoError) << name;
  }
}

TEST(Corpus, RunLengthsGiveEveryPixelOnce) {
  const std::string content = bytes_of("fuzz/corpus/dicom/rle");
  const auto bytes = std::as_bytes(std::span(content));
  MemoryBytes source(bytes);
  const Refuser refuse("rle");
  const DicomFront front = parse_dicom_front(source, refuse);
  const DicomHeader header = parse_dicom(source, front.data_begins, front.syntax, refuse);
  const ByteRange piece = header.pixels[0][0];
  const auto frame = bytes.subspan(piece.begins, piece.bytes);
  std::vector<std::byte> pixels(header.frame_bytes());
  unpack_rle(frame, header, pixels, refuse);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(pixels[2 * i], std::byte{7});  // the run
    EXPECT_EQ(pixels[2 * i + 1], std::byte(i));
  }
  for (std::size_t size = 0; size < frame.size(); ++size) {
    EXPECT_THROW(unpack_rle(frame.first(size), header, pixels, refuse), IoError) << size;
  }
}

}  // namespace
}  // namespace carpus::image_formats

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "phantom/write_phantom.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "case_io/read_volume.hpp"
#include "core/error.hpp"

namespace carpus::phantom {
namespace {

namespace fs = std::filesystem;
using case_io::Overwrite;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A phantom without anatomy: what is written, not what is simulated, matters here.
Phantom block(std::array<int, 3> size, std::uint64_t seed = 7) {
  Phantom phantom;
  GridGeometry g;
  g.size = size;
  g.spacing = {0.5, 0.5, 0.75};
  phantom.ct = Grid<std::int16_t>(g);
  phantom.labels = Grid<std::uint8_t>(g);
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    phantom.ct[i] = static_cast<std::int16_t>(static_cast<int>((i * 7919 + seed) % 3000) - 1000);
    phantom.labels[i] = i % 5 == 0 ? static_cast<std::uint8_t>(BoneId::Lunate) : kBackgroundLabel;
  }
  phantom.options.seed = seed;
  phantom.options.side = Side::Right;
  phantom.options.fracture = FractureKind::None;
  phantom.options.spacing = g.spacing;
  return phantom;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Every file under `folder`, by its path in it.
std::map<std::string, std::string> content_of(const fs::path& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    content[fs::relative(entry.path(), folder).string()] = bytes_of(entry.path());
  }
  return content;
}

std::size_t largest_file(const fs::path& folder) {
  std::size_t largest = 0;
  for (const auto& [name, bytes] : content_of(folder)) largest = std::max(largest, bytes.size());
  return largest;
}

/// Writes while no file may grow beyond `limit` bytes; what was said, or "no error".
std::string message_with_files_up_to(std::size_t limit,
                                     const Phantom& phantom,
                                     const fs::path& folder,
                                     CtFormat format) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = limit;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message = "no error";
  try {
    write_phantom(phantom, folder, format, Overwrite::Replace);
  } catch (const IoError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  return message;
}

class WritePhantom : public ::testing::TestWithParam<CtFormat> {
 protected:
  WritePhantom() { fs::create_directories(parent_); }
  ~WritePhantom() override { fs::remove_all(parent_); }

  [[nodiscard]] fs::path target() const { return parent_ / "patient"; }
  [[nodiscard]] fs::path ct() const {
    return target() / (GetParam() == CtFormat::Dicom ? "dicom" : "ct.nii.gz");
  }
  /// Entries of the parent folder: the patient and whatever was left behind.
  [[nodiscard]] std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(parent_), fs::directory_iterator());
  }

 private:
  fs::path parent_ =
      fs::temp_directory_path() / ("carpus_write_phantom_" + std::to_string(::getpid()));
};

TEST_P(WritePhantom, GivesBackTheVolumesAndTheTruth) {
  const Phantom phantom = block({24, 20, 12});
  write_phantom(phantom, target(), GetParam());
  EXPECT_EQ(entries(), 1);

  const Grid<std::int16_t> ct_again = case_io::read_ct(ct());
  EXPECT_EQ(ct_again.geometry().size, phantom.ct.geometry().size);
  EXPECT_TRUE(std::ranges::equal(ct_again.values(), phantom.ct.values()));
  const Grid<std::uint8_t> labels = case_io::read_labels(target() / "labels.nii.gz");
  EXPECT_TRUE(std::ranges::equal(labels.values(), phantom.labels.values()));

  const auto numbers = nlohmann::json::parse(bytes_of(target() / "labels.json"));
  EXPECT_EQ(numbers,
            (nlohmann::json{{"background", 0}, {"lunate", static_cast<int>(BoneId::Lunate)}}));
  const auto truth = nlohmann::json::parse(bytes_of(target() / "truth.json"));
  EXPECT_EQ(truth["simulated"], true);
  EXPECT_EQ(truth["seed"], 7);
  EXPECT_EQ(truth["side"], "right");
  EXPECT_EQ(truth["fracture"], "none");
  EXPECT_EQ(truth["scan"]["noise_hu"], phantom.options.scan.noise_hu);
  EXPECT_EQ(truth["scan"]["has_fingers"], phantom.options.scan.has_fingers);
  EXPECT_DOUBLE_EQ(truth["volumes_mm3"]["lunate"].get<double>(), 24 * 20 * 12 / 5 * 0.1875);
}

TEST_P(WritePhantom, IsReplacedOnlyOnDemand) {
  write_phantom(block({6, 5, 9}), target(), GetParam());
  const auto first = content_of(target());
  EXPECT_THROW(write_phantom(block({6, 5, 9}, 8), target(), GetParam()), IoError);
  EXPECT_EQ(content_of(target()), first);
  write_phantom(block({6, 5, 9}, 8), target(), GetParam(), Overwrite::Replace);
  EXPECT_NE(content_of(target()), first);
  EXPECT_EQ(entries(), 1);
}

TEST_P(WritePhantom, AFullDiskLeavesTheOldFolderAndNothingElse) {
  // Of the small block truth.json is the largest file, of the others a slice or the whole CT.
  for (const std::array<int, 3> size : {std::array{4, 4, 8}, {24, 20, 12}, {64, 48, 9}}) {
    fs::remove_all(target());
    write_phantom(block(size), target(), GetParam());
    const auto old = content_of(target());
    const std::size_t largest = largest_file(target());
    // From too little for the first file to one byte too little for the largest.
    for (const std::size_t limit :
         {std::size_t{1}, std::size_t{100}, largest / 2, largest - 300, largest - 1}) {
      SCOPED_TRACE(std::to_string(limit) + " of " + std::to_string(largest) + " bytes");
      const std::string message =
          message_with_files_up_to(limit, block(size), target(), GetParam());
      EXPECT_THAT(message, AllOf(HasSubstr("could not be written"), HasSubstr("make room")));
      EXPECT_EQ(content_of(target()), old);
      EXPECT_EQ(entries(), 1);
    }
    // A NIfTI lies there unpacked for a moment.
    const std::size_t unpacked =
        400 + sizeof(std::int16_t) * static_cast<std::size_t>(size[0] * size[1] * size[2]);
    const std::size_t enough = std::max(largest, unpacked);
    EXPECT_EQ(message_with_files_up_to(enough, block(size), target(), GetParam()), "no error");
    EXPECT_EQ(content_of(target()), old);  // the same phantom gives the same bytes
  }
}

INSTANTIATE_TEST_SUITE_P(Format,
                         WritePhantom,
                         ::testing::Values(CtFormat::Dicom, CtFormat::Nifti),
                         [](const auto& tested) {
                           return tested.param == CtFormat::Dicom ? "Dicom" : "Nifti";
                         });

}  // namespace
}  // namespace carpus::phantom

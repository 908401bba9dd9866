// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/given_labels_file.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "case_io/read_dicom_segmentation.hpp"
#include "case_io/read_volume.hpp"
#include "core/error.hpp"
#include "reconstruct/label_names.hpp"

namespace carpus::reconstruct {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestNames = 65536;

using LabelMap = LabelNumbers;

LabelMap read_names(const fs::path& file) {
  if (!fs::is_regular_file(file)) {  // a pipe would wait for whoever writes into it
    throw IoError(file.string() + ": is no regular file; give one with --names");
  }
  if (fs::file_size(file) > kLargestNames) {
    throw InvalidInput(file.string() + ": is larger than any list of names");
  }
  std::ifstream stream(file, std::ios::binary);
  return parse_label_names(std::string(std::istreambuf_iterator<char>(stream), {}), file.string());
}

LabelMap own_numbers() {
  LabelMap map{};
  for (std::uint8_t label = 1; label <= kScaphoidDistalLabel; ++label) map[label] = label;
  return map;
}

/// "Scaphoid (left)" is not guessed at; "Metacarpal 1" is metacarpal1.
LabelMap names_of_segments(const std::vector<std::string>& segments) {
  LabelMap map{};
  for (std::size_t i = 0; i < segments.size() && i + 1 < map.size(); ++i) {
    std::string name;
    for (const char c : segments[i]) {
      if (c == ' ' && name.starts_with("metacarpal")) continue;
      name += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    map[i + 1] = label_of_bone(name).value_or(0);
  }
  return map;
}

bool is_segmentation(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".dcm" || ending == ".DCM" || ending == ".seg" || ending.empty();
}

void rename(const LabelMap& map,
            const std::function<void(const std::string&)>& warn,
            const std::string& file,
            Grid<std::uint8_t>& labels) {
  std::array<std::size_t, 256> left_out{};
  bool has_bone = false;
  for (std::uint8_t& label : labels.values()) {
    const std::uint8_t bone = map[label];
    if (label != 0 && bone == 0) ++left_out[label];
    has_bone = has_bone || bone != 0;
    label = bone;
  }
  for (std::size_t number = 1; number < left_out.size(); ++number) {
    if (left_out[number] == 0) continue;
    warn("number " + std::to_string(number) + " of " + file + " (" +
         std::to_string(left_out[number]) + " voxels) is no bone's and was left out");
  }
  if (!has_bone) {
    throw InvalidInput(file + ": none of its numbers is a bone's; say with --names which is which");
  }
}

}  // namespace

Grid<std::uint8_t> read_given_labels(const fs::path& file,
                                     const fs::path& names,
                                     const GridGeometry& ct,
                                     const std::function<void(const std::string&)>& warn) {
  // Before the long work of reading voxels.
  std::optional<LabelMap> map;
  if (!names.empty()) map = read_names(names);
  Grid<std::uint8_t> labels;
  if (is_segmentation(file)) {
    case_io::ReadSegmentation read = case_io::read_dicom_segmentation(file, ct);
    if (!map) map = names_of_segments(read.names);
    if (read.disputed > 0) {
      warn(std::to_string(read.disputed) + " voxels of " + file.string() +
           " are in two segments; the first has them");
    }
    labels = std::move(read.labels);
  } else {
    labels = case_io::read_labels(file);
    if (!map) map = own_numbers();
  }
  rename(*map, warn, file.string(), labels);
  return labels;
}

}  // namespace carpus::reconstruct

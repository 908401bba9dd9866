// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/scan_files.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

namespace carpus::server {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScan = "/scan/";
/// A packed CT of 512 x 512 x 1000 voxels has half of this.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{512} << 20U;

struct ScanFile {
  std::string_view name;
  const char* media_type;
};
constexpr std::array<ScanFile, 5> kFiles{
    ScanFile{"case.json", "application/json"}, ScanFile{"trust.json", "application/json"},
    ScanFile{"ct.nii.gz", "application/gzip"}, ScanFile{"labels.nii.gz", "application/gzip"},
    ScanFile{"bones.glb", "model/gltf-binary"}};

}  // namespace

bool is_scan_path(std::string_view rest) noexcept {
  return rest.find(kScan) != std::string_view::npos;
}

HttpResponse answer_scan(const CaseShelf& shelf, const TruthGate* gate, std::string_view rest) {
  const std::size_t at = rest.find(kScan);
  const ShelvedCase* found = shelf.find(rest.substr(0, std::min(at, rest.size())));
  const auto* file = kFiles.end();
  if (at != std::string_view::npos) {
    file = std::find_if(kFiles.begin(), kFiles.end(), [&](const ScanFile& each) {
      return each.name == rest.substr(at + kScan.size());
    });
  }
  if (found == nullptr || found->folder.empty() || file == kFiles.end()) {
    return make_problem(404, "There is no such scan.");
  }
  if (gate != nullptr && gate->is_closed()) {
    return make_problem(409,
                        "An assessed operation is under way here; scans are shown again when it "
                        "has ended.");
  }
  const fs::path path = found->folder / file->name;
  std::error_code error;
  // A link in a folder from elsewhere may lead to any file of this machine.
  const bool is_regular = fs::is_regular_file(fs::symlink_status(path, error));
  const std::uintmax_t size = is_regular ? fs::file_size(path, error) : 0;
  if (!is_regular || size > kLargestFile || error) {
    return make_problem(404, "The case has no " + std::string(file->name) + ".");
  }
  // Straight into the answer: a scan is large, and whoever asks again and again would have it
  // twice.
  std::string bytes(size, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) {
    return make_problem(404, "The case's " + std::string(file->name) + " cannot be read.");
  }
  return make_response(200, file->media_type, std::move(bytes));
}

}  // namespace carpus::server

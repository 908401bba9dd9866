// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/meta_image_check.hpp"

#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "core/error.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

std::string trimmed(const std::string& s) {
  const std::size_t first = s.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

/// "Key = value" lines up to ElementDataFile, which is the last; `data_begins` is set behind it.
std::map<std::string, std::string> header_of(const fs::path& file, std::uintmax_t& data_begins) {
  std::map<std::string, std::string> fields;
  std::ifstream in(file, std::ios::binary);
  for (std::string line; fields.size() < 200 && std::getline(in, line);) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    const std::string key = trimmed(line.substr(0, equals));
    fields[key] = trimmed(line.substr(equals + 1));
    if (key == "ElementDataFile") break;
  }
  data_begins = in ? static_cast<std::uintmax_t>(in.tellg()) : 0;
  return fields;
}

}  // namespace

void check_meta_image_is_whole(const fs::path& file, std::uintmax_t bytes) {
  std::uintmax_t data_begins = 0;
  auto fields = header_of(file, data_begins);
  const std::string data_file = fields["ElementDataFile"];
  if (data_file.find('%') != std::string::npos || data_file == "LIST") return;  // many files
  std::error_code error;
  const bool is_local = data_file == "LOCAL" || data_file == "Local" || data_file == "local";
  const fs::path holder = is_local ? file : file.parent_path() / data_file;
  const std::uintmax_t size = fs::file_size(holder, error);
  if (error) {
    throw IoError(holder.string() + ": the voxels of " + file.filename().string() +
                  " are not there; copy it again beside its header");
  }
  std::uintmax_t needed = bytes;
  if (fields["CompressedData"] == "True") {
    needed = std::strtoull(fields["CompressedDataSize"].c_str(), nullptr, 10);
  }
  if (size < (is_local ? data_begins : 0) + needed) {
    throw IoError(holder.string() + ": is cut short; copy it again from its source");
  }
}

}  // namespace carpus::case_io

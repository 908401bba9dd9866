// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/disk_space.hpp"

#include <cstdint>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace carpus::case_io {

void throw_cannot_write(const std::filesystem::path& file, const std::string& sign) {
  std::error_code error;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const auto space = std::filesystem::space(folder, error);
  std::string room;
  if (!error) {
    constexpr std::uintmax_t kBytesPerMegabyte = 1000000;
    room = "; " + std::to_string(space.available / kBytesPerMegabyte) + " MB are free there";
  }
  throw IoError(file.string() +
                ": could not be written whole (disk full, over quota, or no permission" + room +
                "); make room or choose another folder and save again" +
                (sign.empty() ? std::string() : "; read back: " + sign));
}

}  // namespace carpus::case_io

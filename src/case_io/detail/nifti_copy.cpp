// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/nifti_copy.hpp"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "case_io/detail/disk_space.hpp"

namespace carpus::case_io {
namespace {

/// nifti1.h: char descrip[80], ended by a zero.
constexpr std::size_t kDescriptionAt = 148;
constexpr std::size_t kDescriptionBytes = 80;

using GzFile = std::unique_ptr<gzFile_s, int (*)(gzFile)>;

GzFile open(const std::filesystem::path& file, const char* mode) {
  return {gzopen(file.string().c_str(), mode), gzclose};
}

}  // namespace

void copy_nifti(const std::filesystem::path& from,
                const std::filesystem::path& file,
                const std::string& description) {
  const GzFile in = open(from, "rb");
  GzFile out =
      open(file, file.string().ends_with(".gz") ? "wb1R" : "wbT");  // R: runs; T: not packed
  if (!in || !out) throw_cannot_write(file);
  std::vector<char> block(1U << 18U);
  bool is_header = true;
  int got = 0;
  while ((got = gzread(in.get(), block.data(), static_cast<unsigned>(block.size()))) > 0) {
    if (is_header && static_cast<std::size_t>(got) >= kDescriptionAt + kDescriptionBytes) {
      const auto field = block.begin() + kDescriptionAt;
      std::fill_n(field, kDescriptionBytes, '\0');
      std::copy_n(description.begin(), std::min(description.size(), kDescriptionBytes - 1), field);
    }
    is_header = false;
    if (gzwrite(out.get(), block.data(), static_cast<unsigned>(got)) != got) {
      throw_cannot_write(file);
    }
  }
  if (got < 0 || gzclose(out.release()) != Z_OK) throw_cannot_write(file);
}

}  // namespace carpus::case_io

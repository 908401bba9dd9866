// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/output_file.hpp"

#include <unistd.h>

#include <fstream>

#include "core/error.hpp"

namespace carpus::bench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file) {
  throw IoError(file.string() + ": could not be written; check the folder and the disk");
}

}  // namespace

void check_writable(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) {
    throw IoError(file.string() + ": there is no folder " + folder.string() + "; make it first");
  }
  if (fs::is_directory(file)) {
    throw IoError(file.string() + ": is a folder; name a file in it");
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw IoError(file.string() + ": the folder " + folder.string() + " cannot be written to");
  }
}

void write_whole(const fs::path& file, const std::function<void(const fs::path& part)>& write) {
  const fs::path part = file.string() + ".part";
  std::error_code failure;
  try {
    write(part);
    fs::rename(part, file, failure);
    if (failure) fail(file);
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
}

void write_text(const fs::path& file, const std::string& text) {
  write_whole(file, [&](const fs::path& part) {
    std::ofstream out(part);
    out << text;
    out.flush();
    if (!out) fail(file);
  });
}

}  // namespace carpus::bench

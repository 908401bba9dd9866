// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The lengths and angles of the arm, as hardware/parts/numbers.scad has them: their one home
// outside the program, which tests hold to the program's own.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace carpus::hardware {

class Numbers {
 public:
  /// Lines `name = number;`; what is computed from others is not read.
  /// @throws IoError where the file cannot be read.
  explicit Numbers(const std::filesystem::path& file);

  /// @throws IoError where there is no such number.
  [[nodiscard]] double operator[](const std::string& name) const;

 private:
  std::map<std::string, double> values_;
};

}  // namespace carpus::hardware

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hardware/workshop/numbers.hpp"

#include <array>
#include <cstdio>
#include <fstream>

#include "core/error.hpp"

namespace carpus::hardware {

Numbers::Numbers(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw IoError(file.string() + ": cannot be read");
  for (std::string line; std::getline(in, line);) {
    std::array<char, 64> name{};
    double value = 0;
    char end = 0;
    // NAME = NUMBER; and whatever stands behind it. Others are formulas, which nobody asks for
    // here.
    const int read =
        std::sscanf(line.c_str(), "%63[A-Za-z0-9_] = %lf%c", name.data(), &value, &end);
    if (read == 3 && end == ';') values_[name.data()] = value;
  }
}

double Numbers::operator[](const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw IoError("numbers.scad: no number '" + name + "'");
  return found->second;
}

}  // namespace carpus::hardware

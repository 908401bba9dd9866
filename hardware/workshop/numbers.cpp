// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hardware/workshop/numbers.hpp"

#include <fstream>
#include <regex>

#include "core/error.hpp"

namespace carpus::hardware {

Numbers::Numbers(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw IoError(file.string() + ": cannot be read");
  const std::regex line_form(R"(^(\w+) = (-?[0-9.]+);.*)");
  for (std::string line; std::getline(in, line);) {
    std::smatch found;
    if (std::regex_match(line, found, line_form)) values_[found[1]] = std::stod(found[2]);
  }
}

double Numbers::operator[](const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw IoError("numbers.scad: no number '" + name + "'");
  return found->second;
}

}  // namespace carpus::hardware

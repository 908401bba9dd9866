// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/collide_arguments.hpp"
#include "survey/methods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace carpus::cli {
namespace {

constexpr double kUnitTolerance = 1e-3;

std::vector<double> parse_numbers(const std::string& option, const std::string& text) {
  const std::string where = option + " " + text + ": '";
  std::vector<double> numbers;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string word = text.substr(start, end - start);
    char* rest = nullptr;
    const double value = std::strtod(word.c_str(), &rest);
    if (rest == word.c_str() || *rest != '\0') {
      throw UsageError(std::string(where).append(word).append("' is not a number"));
    }
    if (!std::isfinite(value)) {
      throw UsageError(std::string(where).append(word).append("' is not finite"));
    }
    numbers.push_back(value);
    start = end + 1;
  }
  return numbers;
}

/// How many letters must be changed, put in or left out.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

Vec3 parse_vector(const std::string& option, const std::string& text) {
  const std::vector<double> n = parse_numbers(option, text);
  if (n.size() != 3) {
    throw UsageError(option + " " + text + ": three numbers x,y,z are needed, there are " +
                     std::to_string(n.size()));
  }
  return {n[0], n[1], n[2]};
}

Placement parse_pose(const std::string& option, const std::string& text) {
  if (text.empty()) return {};
  const std::vector<double> n = parse_numbers(option, text);
  if (n.size() == 3) return {Mat3::identity(), {n[0], n[1], n[2]}};
  if (n.size() != 7) {
    throw UsageError(option + " " + text +
                     ": x,y,z or x,y,z,qw,qx,qy,qz is needed, that is 3 or 7 numbers; there are " +
                     std::to_string(n.size()));
  }
  const double size = std::sqrt(n[3] * n[3] + n[4] * n[4] + n[5] * n[5] + n[6] * n[6]);
  if (!(std::abs(size - 1) <= kUnitTolerance)) {
    std::array<char, 32> length{};
    std::snprintf(length.data(), length.size(), "%.6g", size);
    throw UsageError(option + " " + text + ": the quaternion qw,qx,qy,qz has length " +
                     length.data() + "; that of a rotation is 1");
  }
  return {rotation_from_quaternion(n[3], n[4], n[5], n[6]), {n[0], n[1], n[2]}};
}

const survey::Method& method_named(const std::string& name) {
  if (const survey::Method* method = survey::find_method(name)) return *method;
  std::string message = "unknown method '" + name + "'";
  std::string near;
  for (const survey::Method& m : survey::all_methods()) {
    const bool is_near =
        edit_distance(name, m.name) <= 2 ||
        (name.size() > 1 && (m.name.find(name) != m.name.npos || name.find(m.name) != name.npos));
    if (is_near) near += (near.empty() ? "" : ", ") + std::string(m.name);
  }
  if (!near.empty()) message += "; near: " + near;
  throw UsageError(message + "; --method list shows all");
}

}  // namespace carpus::cli

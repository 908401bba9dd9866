// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/named_grades.hpp"

#include <algorithm>
#include <cstddef>

#include "arthroscopy/make_lesions.hpp"

namespace carpus::arthroscopy {
namespace {

constexpr std::size_t kLongestName = 64;  // of what is not known, in an error

template <typename Entries>
std::string ids_of(const Entries& entries) {
  std::string ids;
  for (const auto& each : entries) ids += (ids.empty() ? "" : ", ") + each.id;
  return ids;
}

std::string quoted(std::string_view name) {
  std::string text = "'";
  for (const char c : name.substr(0, kLongestName)) {
    text += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return text + "'";
}

template <typename Entries>
auto find(const Entries& entries, std::string_view id) {
  return std::find_if(entries.begin(), entries.end(),
                      [&](const auto& each) { return each.id == id; });
}

}  // namespace

std::vector<NamedGrade> named_grades(const cases::Grades& grades, const PathologyTable& table) {
  std::vector<NamedGrade> named;
  for (std::size_t f = 0; f < table.findings.size(); ++f) {
    if (grades[f] == 0) continue;
    named.push_back({table.findings[f].id, table.scale_of(f).grades.at(grades[f]).id});
  }
  return named;
}

Result<bool> set_grade(cases::Grades& grades,
                       const PathologyTable& table,
                       std::string_view finding,
                       std::string_view grade) {
  const auto what = find(table.findings, finding);
  if (what == table.findings.end()) {
    return carpus::Refusal{"there is no finding " + quoted(finding) + "; there are " +
                           ids_of(table.findings)};
  }
  const auto place = static_cast<std::size_t>(what - table.findings.begin());
  const std::vector<Grade>& scale = table.scale_of(place).grades;
  const auto how = find(scale, grade);
  if (how == scale.end()) {
    return carpus::Refusal{what->id + " has no grade " + quoted(grade) + "; it has " +
                           ids_of(scale)};
  }
  grades[place] = static_cast<std::uint8_t>(how - scale.begin());
  return true;
}

std::vector<std::string> grades_in_words(const cases::Grades& grades, const PathologyTable& table) {
  std::vector<std::string> words;
  for (std::size_t f = 0; f < table.findings.size(); ++f) {
    if (grades[f] == 0) continue;
    words.push_back(table.findings[f].label + ": " + table.scale_of(f).grades.at(grades[f]).label);
  }
  return words;
}

cases::PreparedPathology drawn_pathology(std::uint64_t seed, const PathologyTable& table) {
  return {grades_by(seed, table), seed, true};
}

}  // namespace carpus::arthroscopy

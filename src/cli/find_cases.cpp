// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/find_cases.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "anatomy/bone_id.hpp"
#include "case_io/case_cover.hpp"
#include "case_io/lesson_file.hpp"
#include "case_io/trust_file.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestId = 64;
constexpr double kWithoutLesson = 101;  // after all that have one

bool is_case(const fs::path& folder) { return fs::exists(folder / "case.json"); }

std::vector<fs::path> cases_in(const fs::path& place) {
  // A single one may be damaged or missing: whoever loads it says so.
  if (is_case(place) || !fs::is_directory(place)) return {place};
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(place)) {
    if (entry.is_directory() && is_case(entry.path())) found.push_back(entry.path());
  }
  if (found.empty()) return {place};
  std::sort(found.begin(), found.end());
  return found;
}

std::string id_of(const fs::path& folder) {
  const fs::path name = fs::absolute(folder).lexically_normal();
  return (name.has_filename() ? name : name.parent_path())
      .filename()
      .string()
      .substr(0, kLongestId);
}

/// A damaged file takes no case away; the scan's page tells what is wrong with it.
case_io::Trust trust_in(const fs::path& folder) {
  try {
    return case_io::read_trust(folder).value_or(case_io::Trust{});
  } catch (const Error&) {
    return {};
  }
}

std::vector<std::string> flagged_in(const case_io::Trust& trust) {
  std::vector<std::string> bones;
  for (const case_io::TrustLine& line : trust.bones) {
    if (!line.flagged) continue;
    const std::string bone(name_of(bone_of(line.name)->bone));
    if (std::find(bones.begin(), bones.end(), bone) == bones.end()) bones.push_back(bone);
  }
  return bones;
}

void sort_by_difficulty(std::vector<server::ShelvedCase>& all) {
  std::stable_sort(
      all.begin(), all.end(), [](const server::ShelvedCase& a, const server::ShelvedCase& b) {
        return a.difficulty.value_or(kWithoutLesson) < b.difficulty.value_or(kWithoutLesson);
      });
}

}  // namespace

server::ShelvedCase shelved_case(const fs::path& folder) {
  server::ShelvedCase result;
  result.id = id_of(folder);
  result.folder = folder;
  result.name = case_io::read_pseudonym(folder).value_or(result.id);
  result.title = result.name;
  case_io::Trust trust = trust_in(folder);
  result.flagged = flagged_in(trust);
  result.of_scan = std::move(trust.of_scan);
  if (std::optional<std::string> preview = case_io::read_preview(folder)) {
    result.preview = std::make_shared<const std::string>(std::move(*preview));
  }
  const std::optional<cases::Lesson> lesson = case_io::read_lesson(folder);
  if (!lesson) return result;
  result.title = lesson->title;
  result.history = lesson->history;
  result.goal = lesson->goal;
  result.difficulty = lesson->difficulty.overall;
  return result;
}

FoundCases find_cases(const std::vector<std::string>& places) {
  FoundCases found;
  for (const std::string& place : places) {
    const std::size_t before = found.shelf.cases.size();
    for (const fs::path& folder : cases_in(place)) {
      server::ShelvedCase one = shelved_case(folder);
      if (!found.folders.emplace(one.id, folder).second) {
        throw InvalidInput("two cases are called '" + one.id +
                           "'; rename the folder of one, or serve one of them");
      }
      found.shelf.cases.push_back(std::move(one));
    }
    if (before > 0) continue;
    sort_by_difficulty(found.shelf.cases);
    found.shelf.open = found.shelf.cases.front().id;
  }
  if (found.shelf.cases.size() > kMostCases) {
    throw InvalidInput("there are " + std::to_string(found.shelf.cases.size()) +
                       " cases; serve at most " + std::to_string(kMostCases));
  }
  sort_by_difficulty(found.shelf.cases);
  return found;
}

}  // namespace carpus::cli

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/pathology_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "arthroscopy/named_grades.hpp"
#include "case_io/case_cover.hpp"
#include "case_io/pathology_file.hpp"
#include "cli/case_pathology.hpp"
#include "cli/corrected_case.hpp"
#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "cli/seed_option.hpp"
#include "core/error.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using arthroscopy::PathologyTable;
using Pathology = std::optional<cases::PreparedPathology>;

struct Arguments {
  fs::path case_folder = kDefaultCase;
  std::vector<std::string> set;
  std::uint64_t seed = 0;
  std::string by_seed;
  bool healthy = false;
  bool clear = false;
  std::string json;

  [[nodiscard]] bool changes() const {
    return !set.empty() || healthy || clear || !by_seed.empty();
  }
};

const PathologyTable& table() { return PathologyTable::generic(); }

/// What may be chosen, a line a finding.
std::string choices() {
  std::string text = "Findings and their grades (0 is well):\n";
  for (std::size_t f = 0; f < table().findings.size(); ++f) {
    text += "  " + table().findings[f].id + "=";
    std::string ids;
    for (const arthroscopy::Grade& grade : table().scale_of(f).grades) {
      ids += (ids.empty() ? "" : "|") + grade.id;
    }
    text += ids + "  " + table().findings[f].label + "\n";
  }
  return text;
}

std::uint64_t checked_seed(std::uint64_t seed) {
  if (seed <= cases::kMostPathologySeed) return seed;
  throw UsageError("the seed is at most " + std::to_string(cases::kMostPathologySeed) +
                   ", the largest number that the file keeps exactly");
}

cases::PreparedPathology chosen(const Arguments& a) {
  cases::PreparedPathology pathology;
  pathology.seed = checked_seed(a.seed);
  for (const std::string& each : a.set) {
    const std::size_t sign = each.find('=');
    if (sign == std::string::npos) {
      throw UsageError("--set " + each + ": write FINDING=GRADE, such as scapholunate=III");
    }
    const auto set =
        set_grade(pathology.grades, table(), each.substr(0, sign), each.substr(sign + 1));
    if (!set) throw UsageError("--set " + each + ": " + set.error());
  }
  return pathology;
}

Pathology wished(const Arguments& a) {
  if (a.clear) return std::nullopt;
  if (a.by_seed.empty()) return chosen(a);
  return arthroscopy::drawn_pathology(checked_seed(std::stoull(a.by_seed)), table());
}

const char* origin_of(const Pathology& pathology) {
  if (!pathology) return "random";
  return pathology->is_drawn ? "seed" : "chosen";
}

std::string in_words(const Pathology& pathology) {
  if (!pathology) return "at random: each examination's seed decides\n";
  std::string text = pathology->is_drawn ? "by seed " + std::to_string(pathology->seed) : "chosen";
  text += ", the same in each examination\n";
  const std::vector<std::string> wrong = arthroscopy::grades_in_words(pathology->grades, table());
  for (const std::string& each : wrong) text += "  " + each + "\n";
  return text + (wrong.empty() ? "  a healthy wrist\n" : "  all else is well\n");
}

std::string as_json(const std::string& name, const Pathology& pathology) {
  nlohmann::ordered_json json;
  json["case"] = name;
  json["origin"] = origin_of(pathology);
  json["seed"] = pathology ? nlohmann::ordered_json(pathology->seed) : nullptr;
  json["grades"] = nlohmann::ordered_json::object();
  if (pathology) {
    for (const auto& [finding, grade] : arthroscopy::named_grades(pathology->grades, table())) {
      json["grades"][finding] = grade;
    }
  }
  return json.dump(1) + "\n";
}

/// What was asked for and cannot be seen is said, not refused: the case may get its tissue later.
void warn_of_unseen(const fs::path& folder, const cases::PreparedPathology& pathology) {
  const cases::CaseData data = load_case(folder);
  if (data.arthroscopy == nullptr) {
    std::fprintf(stderr,
                 "carpus: this case has no soft tissue and cannot be examined yet; 'carpus "
                 "soft-tissue %s' makes it\n",
                 folder.c_str());
    return;
  }
  for (const std::string& label : findings_without_place(data, pathology)) {
    std::fprintf(stderr,
                 "carpus: %s: this case has no place to show it; an examination takes it as well\n",
                 label.c_str());
  }
}

void run(const Arguments& a) {
  if (!is_case_folder(a.case_folder)) {
    throw InvalidInput(a.case_folder.string() + ": is no case; give the folder of one");
  }
  if (a.changes()) {
    const Pathology pathology = wished(a);
    write_pathology(a.case_folder, pathology);
    if (pathology) warn_of_unseen(a.case_folder, *pathology);
  }
  const Pathology held = case_io::read_pathology(a.case_folder);
  const std::string name =
      case_io::read_pseudonym(a.case_folder).value_or(a.case_folder.filename().string());
  std::printf("%s: %s", name.c_str(), in_words(held).c_str());
  if (!a.json.empty()) records::write_file_atomically(a.json, as_json(name, held));
}

}  // namespace

void add_pathology_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "pathology",
      "Prepare what is wrong in a case's joints when they are examined; without options tell it");
  command->footer(choices);
  command->add_option("case", a->case_folder, "Case folder")->capture_default_str();
  CLI::Option* set = command->add_option("--set", a->set,
                                         "FINDING=GRADE, several times; what is not named is well");
  set->allow_extra_args(false);
  add_seed_option(*command, a->seed, "Of --set: where within its place a patch lies");
  command->get_option("--seed")->needs(set);
  CLI::Option* healthy = command->add_flag("--healthy", a->healthy, "Nothing is wrong");
  CLI::Option* by_seed =
      command->add_option("--by-seed", a->by_seed, "What this seed draws, in each examination")
          ->check(whole_number());
  CLI::Option* clear = command->add_flag("--clear", a->clear,
                                         "At random again: each examination's own seed decides");
  set->excludes(healthy, by_seed, clear);
  healthy->excludes(by_seed, clear);
  by_seed->excludes(clear);
  command->add_option("--json", a->json, "Write what the case holds to this file")
      ->check(output_file());
  command->callback([a] { run(*a); });
}

}  // namespace carpus::cli

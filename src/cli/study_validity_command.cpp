// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/study_validity_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "cli/seed_option.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "procedures/built_in.hpp"
#include "records/atomic_file.hpp"
#include "trainee/attempt.hpp"
#include "trainee/validity.hpp"

namespace carpus::cli {
namespace {

using trainee::ProcedureValidity;
using trainee::ScoredOperation;
using trainee::Skill;

constexpr std::array kSkills{Skill::Expert, Skill::Middle, Skill::Novice};
constexpr std::array kUpwards{Skill::Novice, Skill::Middle, Skill::Expert};

struct StudyValidityArguments {
  std::vector<std::string> cases{kDefaultCase};
  std::vector<std::string> procedures;  ///< ids; empty: all
  std::size_t seeds = 6;
  std::uint64_t first_seed = 1;
  std::string json;
};

struct Progress {
  const StudyValidityArguments& arguments;
  std::size_t planned = 0;  ///< operations
  std::atomic<std::size_t> done = 0;
};

/// Every skill on every seed, in parallel; the order is fixed beforehand.
void operate_on(const cases::CaseData& data,
                std::size_t case_index,
                const procedure::Procedure& procedure,
                Progress& progress,
                std::vector<ScoredOperation>& operations) {
  const StudyValidityArguments& arguments = progress.arguments;
  const std::size_t first = operations.size();
  const std::size_t count = arguments.seeds * kSkills.size();
  operations.resize(first + count);
  const std::string stage = procedure.id + ", " + data.pseudonym;
  parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      ScoredOperation& one = operations[first + i];
      one.skill = kSkills[i % kSkills.size()];
      one.case_index = case_index;
      one.score = trainee::score_of_operation(data, procedure, one.skill,
                                              arguments.first_seed + i / kSkills.size());
      // Of thousands of operations nobody looks at the picture, a megabyte and a half each.
      one.score.placement = {};
      std::fprintf(stderr, "\r%zu of %zu operations (%s)   ", ++progress.done, progress.planned,
                   stage.c_str());
    }
  });
}

std::string in_columns(const trainee::Separation& separation) {
  std::array<char, 64> text{};
  if (separation.effect_size) {
    std::snprintf(text.data(), text.size(), "%6.2f  %6.1f", separation.auc,
                  *separation.effect_size);
  } else {
    std::snprintf(text.data(), text.size(), "%6.2f       -", separation.auc);
  }
  return text.data();
}

double of(const trainee::ItemValidity& item, Skill skill, double trainee::ItemMeans::*figure) {
  return item.means[static_cast<std::size_t>(skill)].*figure;
}

/// So near to chance a counted item tells nothing of skill; below it is turned round.
constexpr double kNothingBelowAuc = 0.55;
constexpr double kTurnedBelowAuc = 0.45;

/// What a reader should not miss.
std::string remark_on(const trainee::ItemValidity& item) {
  using trainee::ItemMeans;
  std::string remark = item.counted ? "" : "  not counted";
  if (item.separation.auc < kTurnedBelowAuc) {
    remark += "  TURNED ROUND";
  } else if (item.counted && item.separation.auc < kNothingBelowAuc) {
    remark += "  TELLS NOTHING";
  }
  if (!item.is_in_order()) remark += "  middle not between";
  const double novice = of(item, Skill::Novice, &ItemMeans::measured_share);
  const double middle = of(item, Skill::Middle, &ItemMeans::measured_share);
  const double expert = of(item, Skill::Expert, &ItemMeans::measured_share);
  if (std::min({novice, middle, expert}) < 1.0) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "  measured %.0f, %.0f, %.0f %%", 100 * novice,
                  100 * middle, 100 * expert);
    remark += text.data();
    if (item.where_measured) {
      std::snprintf(text.data(), text.size(), ": AUC %.2f there", item.where_measured->auc);
      remark += text.data();
    }
  }
  return remark;
}

void print_items(const ProcedureValidity& validity) {
  std::printf("\n%s\n%-26s %6s %7s   %-21s %s\n", validity.name.c_str(), "expert against novice",
              "AUC", "effect", "earned, %", "mean value: novice, middle, expert");
  std::printf("%-26s %s\n", "total", in_columns(validity.total).c_str());
  for (const trainee::ItemValidity& item : validity.items) {
    std::printf("%-26s %s  ", item.id.c_str(), in_columns(item.separation).c_str());
    for (const Skill skill : kUpwards) {
      std::printf(" %5.0f", 100 * of(item, skill, &trainee::ItemMeans::earned_share));
    }
    std::printf("   ");
    for (const Skill skill : kUpwards) {
      const auto& value = item.means[static_cast<std::size_t>(skill)].value;
      value ? std::printf(" %8.4g", *value) : std::printf(" %8s", "-");
    }
    std::printf("%s\n", remark_on(item).c_str());
  }
}

void print(const ProcedureValidity& validity, const std::vector<std::string>& names) {
  print_items(validity);
  std::printf("%-32s %8s %8s %8s %6s   all must-haves\n", "mean total on", "novice", "middle",
              "expert", "AUC");
  for (std::size_t c = 0; c < validity.cases.size(); ++c) {
    const trainee::CaseMeans& means = validity.cases[c];
    const auto by_skill = [](const auto& by, Skill skill) {
      return by[static_cast<std::size_t>(skill)];
    };
    std::printf("%-32.32s %8.1f %8.1f %8.1f %6.2f   %3.0f %% %3.0f %% %3.0f %%%s\n",
                names[c].c_str(), by_skill(means.total, Skill::Novice),
                by_skill(means.total, Skill::Middle), by_skill(means.total, Skill::Expert),
                means.separation.auc, 100 * by_skill(means.safe_share, Skill::Novice),
                100 * by_skill(means.safe_share, Skill::Middle),
                100 * by_skill(means.safe_share, Skill::Expert),
                means.is_in_order() ? "" : "   NOT IN ORDER");
    for (const trainee::MissedShare& missed : means.missed) {
      const auto percent = [&](Skill skill) { return 100 * by_skill(missed.share, skill); };
      std::printf("  missed: %-22.22s %6.0f %% %6.0f %% %6.0f %%\n", missed.id.c_str(),
                  percent(Skill::Novice), percent(Skill::Middle), percent(Skill::Expert));
    }
  }
}

nlohmann::json json_of(const ProcedureValidity& validity, const std::vector<std::string>& names) {
  const auto effect = [](const trainee::Separation& separation) {
    return separation.effect_size ? nlohmann::json(*separation.effect_size) : nlohmann::json();
  };
  nlohmann::json json = {{"name", validity.name},
                         {"auc_total", validity.total.auc},
                         {"effect_size_total", effect(validity.total)},
                         {"items", nlohmann::json::array()},
                         {"cases", nlohmann::json::array()}};
  for (const trainee::ItemValidity& item : validity.items) {
    nlohmann::json one = {{"id", item.id},
                          {"auc", item.separation.auc},
                          {"effect_size", effect(item.separation)},
                          {"auc_where_measured", nullptr},
                          {"counted", item.counted}};
    if (item.where_measured) one["auc_where_measured"] = item.where_measured->auc;
    for (const Skill skill : kSkills) {
      const trainee::ItemMeans& means = item.means[static_cast<std::size_t>(skill)];
      one["earned_share"][trainee::name_of(skill)] = means.earned_share;
      one["measured_share"][trainee::name_of(skill)] = means.measured_share;
      one["mean_value"][trainee::name_of(skill)] =
          means.value ? nlohmann::json(*means.value) : nlohmann::json();
    }
    json["items"].push_back(std::move(one));
  }
  for (std::size_t c = 0; c < validity.cases.size(); ++c) {
    nlohmann::json means = {{"case", names[c]},
                            {"in_order", validity.cases[c].is_in_order()},
                            {"auc", validity.cases[c].separation.auc}};
    for (const Skill skill : kSkills) {
      means["total"][trainee::name_of(skill)] =
          validity.cases[c].total[static_cast<std::size_t>(skill)];
      means["safe_share"][trainee::name_of(skill)] =
          validity.cases[c].safe_share[static_cast<std::size_t>(skill)];
      for (const trainee::MissedShare& missed : validity.cases[c].missed) {
        means["missed"][missed.id][trainee::name_of(skill)] =
            missed.share[static_cast<std::size_t>(skill)];
      }
    }
    json["cases"].push_back(std::move(means));
  }
  return json;
}

/// Every operation by itself, so that limits can be tried on what was measured without operating
/// anew.
nlohmann::json json_of(const std::vector<ScoredOperation>& operations,
                       const std::vector<std::string>& names) {
  nlohmann::json all = nlohmann::json::array();
  for (const ScoredOperation& one : operations) {
    nlohmann::json json = {{"skill", trainee::name_of(one.skill)},
                           {"case", names[one.case_index]},
                           {"total", one.score.overall}};
    for (const procedure::ScoreItem& item : one.score.items) {
      json["values"][item.id] = item.value ? nlohmann::json(*item.value) : nlohmann::json();
    }
    all.push_back(std::move(json));
  }
  return all;
}

/// Of the cases so far, where a file is wanted.
void write_json(const StudyValidityArguments& arguments,
                const std::vector<std::string>& names,
                bool is_simulated,
                const std::vector<ProcedureValidity>& found,
                const std::vector<std::vector<ScoredOperation>>& operations) {
  if (arguments.json.empty()) return;
  nlohmann::json json = {{"in_silico", true},
                         {"seeds", arguments.seeds},
                         {"cases", names},
                         {"cases_planned", arguments.cases.size()},
                         {"cases_simulated", is_simulated},
                         {"procedures", nlohmann::json::array()}};
  for (std::size_t p = 0; p < found.size(); ++p) {
    json["procedures"].push_back(json_of(found[p], names));
    json["procedures"].back()["operations"] = json_of(operations[p], names);
  }
  records::write_file_atomically(arguments.json, json.dump(2) + "\n");
}

/// @throws InvalidInput where one is not offered.
std::vector<const procedure::Procedure*> chosen(const std::vector<std::string>& ids) {
  const procedure::ProcedureList& list = procedures::built_in();
  const auto all = list.all();
  std::vector<const procedure::Procedure*> offered(all.begin(), all.end());
  if (ids.empty()) return offered;
  for (const std::string& id : ids) {
    if (std::none_of(all.begin(), all.end(), [&](const auto* one) { return one->id == id; })) {
      throw InvalidInput("there is no procedure '" + id +
                         "'; 'carpus simulate --procedure list' shows them");
    }
  }
  std::erase_if(offered,
                [&](const auto* one) { return std::ranges::find(ids, one->id) == ids.end(); });
  return offered;
}

void run(const StudyValidityArguments& arguments) {
  const auto offered = chosen(arguments.procedures);
  std::vector<std::vector<ScoredOperation>> operations(offered.size());
  std::vector<std::string> names;
  bool is_simulated = true;
  Progress progress{arguments,
                    arguments.seeds * kSkills.size() * arguments.cases.size() * offered.size()};
  std::vector<ProcedureValidity> found;
  for (std::size_t c = 0; c < arguments.cases.size(); ++c) {
    const cases::CaseData data = load_case(arguments.cases[c]);
    names.push_back(data.pseudonym);
    is_simulated = is_simulated && data.provenance.simulated;
    found.clear();
    for (std::size_t p = 0; p < offered.size(); ++p) {
      operate_on(data, c, *offered[p], progress, operations[p]);
      found.push_back(trainee::validity_of(*offered[p], operations[p], names.size()));
    }
    // An hour's study that is stopped leaves what it had found.
    write_json(arguments, names, is_simulated, found, operations);
  }
  std::fprintf(stderr, "\n");
  std::printf(
      "Scripted trainees, %zu of each skill on each of %zu case%s%s: in silico, no people.\n",
      arguments.seeds, names.size(), names.size() == 1 ? "" : "s",
      is_simulated ? " (simulated)" : "");
  for (const ProcedureValidity& validity : found) print(validity, names);
}

}  // namespace

void add_study_validity_command(CLI::App& study) {
  auto arguments = std::make_shared<StudyValidityArguments>();
  CLI::App* command = study.add_subcommand(
      "validity", "Whether each item of the score separates scripted experts from novices");
  command->add_option("--cases", arguments->cases, "Case folders")->capture_default_str();
  command->add_option("--procedures", arguments->procedures,
                      "Ids of those operated; all if left out (an arthroscopy needs soft tissue)");
  command->add_option("--seeds", arguments->seeds, "Operations of each skill on each case")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  add_seed_option(*command, arguments->first_seed, "Of the first operation; the next has the next");
  command->add_option("--json", arguments->json, "Write the figures to this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli

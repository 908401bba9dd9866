// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/stock_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case_io/lesson_file.hpp"
#include "cli/progress_line.hpp"
#include "core/error.hpp"
#include "records/utc_time.hpp"
#include "stock/make_stock_case.hpp"
#include "stock/stock_list.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

struct StockArguments {
  std::string out = "cases";
  std::vector<std::string> only;
  bool list = false;
};

std::string proof_in_words(const cases::Lesson& lesson) {
  if (lesson.right_answer == cases::RightAnswer::Decline) return "not tried";
  if (!lesson.expert) return "no procedure that the scripts know";
  const std::string score = std::to_string(static_cast<int>(lesson.expert->overall)) + " of 100";
  return (lesson.expert->is_acceptable ? "acceptable, " : "NOT acceptable, ") + score;
}

void print(const stock::StockItem& item, const cases::Lesson& lesson, const std::string& time) {
  const cases::Difficulty& d = lesson.difficulty;
  std::printf(
      "%-26s %-12s difficulty %3.0f  clearance %5.2f mm  smaller part %4.1f mm  expert: %s  %s\n",
      item.id.c_str(), std::string(name_of(lesson.right_answer)).c_str(), d.overall,
      d.corridor_clearance_mm, d.smaller_part_mm, proof_in_words(lesson).c_str(), time.c_str());
  std::fflush(stdout);
}

cases::Lesson make(const stock::StockItem& item, const fs::path& folder) {
  const auto before = std::chrono::steady_clock::now();
  const cases::Lesson lesson =
      stock::make_stock_case(item, folder, records::utc_now(), show_progress);
  const auto took = std::chrono::steady_clock::now() - before;
  print(item, lesson,
        std::to_string(std::chrono::duration_cast<std::chrono::seconds>(took).count()) + " s");
  return lesson;
}

void refuse_unknown(const std::vector<std::string>& ids) {
  std::string known;
  for (const stock::StockItem& item : stock::stock_list()) known += " " + item.id;
  for (const std::string& id : ids) {
    const bool is_known = std::any_of(stock::stock_list().begin(), stock::stock_list().end(),
                                      [&](const stock::StockItem& item) { return item.id == id; });
    if (!is_known) throw UsageError("stock: there is no case '" + id + "'; there are" + known);
  }
}

void run(const StockArguments& arguments) {
  refuse_unknown(arguments.only);
  std::vector<std::string> unsolved;
  for (const stock::StockItem& item : stock::stock_list()) {
    if (arguments.list) {
      std::printf("%-26s %s\n", item.id.c_str(), item.lesson.title.c_str());
      continue;
    }
    const bool is_asked =
        arguments.only.empty() ||
        std::find(arguments.only.begin(), arguments.only.end(), item.id) != arguments.only.end();
    if (!is_asked) continue;
    const fs::path folder = fs::path(arguments.out) / item.id;
    fs::create_directories(arguments.out);
    cases::Lesson lesson;
    if (stock::is_made(folder, item)) {
      lesson = case_io::read_lesson(folder).value();
      print(item, lesson, "there already");
    } else {
      lesson = make(item, folder);
    }
    const bool is_solved = lesson.expert && lesson.expert->is_acceptable;
    if (lesson.right_answer != cases::RightAnswer::Decline && !is_solved)
      unsolved.push_back(item.id);
  }
  if (unsolved.empty()) return;
  std::string text;
  for (const std::string& id : unsolved) text += " " + id;
  throw InvalidInput("the scripted expert reached no acceptable fixation of:" + text +
                     "; their lessons say so");
}

}  // namespace

void add_stock_command(CLI::App& app) {
  auto arguments = std::make_shared<StockArguments>();
  CLI::App* command = app.add_subcommand(
      "stock", "Make the stock of practice cases (simulated); goes on where it was stopped");
  command->add_option("--out", arguments->out, "Folder of the cases' folders")
      ->capture_default_str();
  command->add_option("--only", arguments->only, "Make these alone");
  command->add_flag("--list", arguments->list, "Only say which there are");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/stock_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
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

const char* answer_in_words(cases::RightAnswer answer) {
  switch (answer) {
    case cases::RightAnswer::Fix:
      return "fix the scaphoid as it lies";
    case cases::RightAnswer::ReduceFirst:
      return "reduce the fracture, then fix it";
    case cases::RightAnswer::Decline:
      break;
  }
  return "decline: nothing for a screw through the skin";
}

std::string proof_in_words(const cases::Lesson& lesson) {
  if (lesson.right_answer == cases::RightAnswer::Decline) return "has not tried it";
  if (!lesson.expert) return "knows no procedure for it";
  const std::string score = std::to_string(std::lround(lesson.expert->overall)) + " of 100 points";
  return (lesson.expert->is_acceptable ? "fixed it acceptably, " : "did NOT fix it acceptably, ") +
         score;
}

void print(const stock::StockItem& item, const cases::Lesson& lesson, const std::string& time) {
  const cases::Difficulty& d = lesson.difficulty;
  std::printf(
      "%s: %s (%s)\n  right answer: %s\n"
      "  difficulty: %.0f of 100; room about the screw %.2f mm, smaller part %.1f mm\n"
      "  scripted expert: %s\n",
      item.id.c_str(), lesson.title.c_str(), time.c_str(), answer_in_words(lesson.right_answer),
      d.overall, d.corridor_clearance_mm, d.smaller_part_mm, proof_in_words(lesson).c_str());
  std::fflush(stdout);
}

cases::Lesson make(const stock::StockItem& item, const fs::path& folder) {
  const auto before = std::chrono::steady_clock::now();
  const cases::Lesson lesson =
      stock::make_stock_case(item, folder, records::utc_now(), show_progress);
  const auto took = std::chrono::steady_clock::now() - before;
  print(item, lesson,
        "made in " +
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
  if (arguments.list) return;
  std::printf("The cases are in %s, simulated. To operate on them: ./run --case %s\n",
              arguments.out.c_str(), arguments.out.c_str());
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

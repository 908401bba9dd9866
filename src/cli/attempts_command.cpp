// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/attempts_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "records/atomic_file.hpp"
#include "records/attempt_store.hpp"
#include "records/records_care.hpp"
#include "server/attempt_messages.hpp"

namespace carpus::cli {
namespace {

struct AttemptsArguments {
  std::string records = kDefaultRecords;
  std::string json;
  std::int64_t export_id = 0;
  std::string out;
  bool check = false;
  bool repair = false;
  std::string backup;
};

/// A page of the protocol's list after another, as one.
nlohmann::ordered_json whole_list(const records::AttemptStore& store) {
  auto whole = nlohmann::ordered_json::parse(protocol::serialize(server::attempt_list({})));
  std::int64_t before = 0;
  for (bool older = true; older;) {
    const records::AttemptPage page = store.page(before, protocol::kMaxAttemptListAttempts);
    const auto json =
        nlohmann::ordered_json::parse(protocol::serialize(server::attempt_list(page)));
    for (const auto& attempt : json["attempts"]) whole["attempts"].push_back(attempt);
    whole["total"] = json["total"];
    older = page.older;
    if (older) before = page.attempts.back().id;
  }
  return whole;
}

void check(const AttemptsArguments& arguments) {
  const records::RecordsCheck found = records::check_records(arguments.records);
  for (const std::string& problem : found.problems) std::printf("%s\n", problem.c_str());
  for (const std::string& waiting : found.waiting) std::printf("%s\n", waiting.c_str());
  std::printf("%lld attempts can be read\n", static_cast<long long>(found.attempts));
  if (!found.problems.empty()) {
    throw IoError("records " + arguments.records +
                  " are damaged; 'carpus attempts --repair' saves what can be read of them");
  }
}

void repair(const AttemptsArguments& arguments) {
  if (records::check_records(arguments.records).problems.empty()) {
    std::printf("%s is sound; nothing was changed\n", arguments.records.c_str());
    return;
  }
  const records::RecordsRepair done = records::repair_records(arguments.records);
  std::printf("%lld attempts saved, %zu lost", static_cast<long long>(done.saved),
              done.lost.size());
  for (const std::int64_t id : done.lost) std::printf(" %lld", static_cast<long long>(id));
  std::printf("; the damaged file is %s\n", done.damaged.c_str());
}

void back_up(const AttemptsArguments& arguments) {
  const std::int64_t attempts = records::back_up_records(arguments.records, arguments.backup);
  std::printf("%lld attempts copied to %s\n", static_cast<long long>(attempts),
              arguments.backup.c_str());
}

void export_recording(const records::AttemptStore& store, const AttemptsArguments& arguments) {
  const auto attempt = store.find(arguments.export_id);
  if (!attempt) {
    throw InvalidInput(arguments.records + ": there is no attempt " +
                       std::to_string(arguments.export_id) +
                       "; 'carpus attempts' lists what there is");
  }
  records::write_file_atomically(arguments.out, attempt->recording);
  std::printf("attempt %lld: %zu bytes written to %s\n",
              static_cast<long long>(arguments.export_id), attempt->recording.size(),
              arguments.out.c_str());
}

void run(const AttemptsArguments& arguments) {
  if (!std::filesystem::exists(arguments.records)) {
    throw IoError(arguments.records + ": no such file; name the records with --records");
  }
  if (arguments.check) return check(arguments);
  if (arguments.repair) return repair(arguments);
  if (!arguments.backup.empty()) return back_up(arguments);
  const records::AttemptStore store(arguments.records);
  if (arguments.export_id != 0) return export_recording(store, arguments);
  const auto attempts = store.list();
  std::fputs(attempts_table(attempts).c_str(), stdout);
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, whole_list(store).dump(2) + "\n");
  }
}

}  // namespace

namespace {

/// As wide as `width` letters, whatever bytes they take.
std::string padded(const std::string& text, std::size_t width) {
  std::string result;
  std::size_t letters = 0;
  for (const char c : text) {
    const bool begins_letter = (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    if (begins_letter && letters++ == width) break;
    result += c;
  }
  return result + std::string(width - std::min(letters, width), ' ');
}

}  // namespace

std::string attempts_table(const std::vector<records::AttemptSummary>& attempts) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(), "%6s  %-24s  %-20s  %-28s  %-33s  %-8s  %8s  %7s  %s\n",
                "id", "started (UTC)", "trainee", "case", "procedure", "input", "seconds", "score",
                "state hash");
  std::string table = line.data();
  for (const records::AttemptSummary& attempt : attempts) {
    const std::string score = attempt.overall ? std::to_string(*attempt.overall).substr(0, 5)
                                              : std::string(name_of(attempt.outcome)).substr(0, 7);
    const std::string of_case =
        attempt.case_name.substr(0, 16) + simulated_mark(attempt.case_simulated.value_or(false));
    std::snprintf(
        line.data(), line.size(), "%6lld  %-24s  %s  %s  %-33s  %-8.8s  %8.1f  %7.7s  %s\n",
        static_cast<long long>(attempt.id), attempt.started_at.c_str(),
        padded(attempt.trainee, 20).c_str(), padded(of_case, 28).c_str(), attempt.procedure.c_str(),
        attempt.input_device.c_str(), static_cast<double>(attempt.duration_ticks) / 1000.0,
        score.c_str(), attempt.final_hash.c_str());
    table += line.data();
  }
  return table + std::to_string(attempts.size()) + " attempts\n";
}

void add_attempts_command(CLI::App& app) {
  auto arguments = std::make_shared<AttemptsArguments>();
  CLI::App* command = app.add_subcommand(
      "attempts", "List attempts, export their recordings, look after their file");
  command->add_option("--records", arguments->records, "File with the attempts")
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write the list to this file")
      ->check(output_file());
  CLI::Option* id = command->add_option("--export", arguments->export_id,
                                        "Number of the attempt whose recording is taken out");
  CLI::Option* out =
      command->add_option("--out", arguments->out, "File for the recording")->check(output_file());
  id->needs(out);
  out->needs(id);
  CLI::Option* care = command->add_flag("--check", arguments->check, "Look through the whole file");
  CLI::Option* mend =
      command->add_flag("--repair", arguments->repair, "Save what can be read of a damaged file");
  CLI::Option* copy =
      command
          ->add_option("--backup", arguments->backup,
                       "Copy the records to this file; a station may go on meanwhile")
          ->check(output_file());
  mend->excludes(care)->excludes(copy)->excludes(id);
  copy->excludes(care)->excludes(id);
  care->excludes(id);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli

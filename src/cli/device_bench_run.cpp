// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/device_bench_run.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "cli/device_bench_picture.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "device_bench/rows.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

using device_bench::Law;
using device_bench::Row;
using device_bench::Stage;

constexpr Law kLaws[] = {Law::Thesis, Law::Ours};
constexpr firmware::Drive kDrives[] = {firmware::Drive::Stop, firmware::Drive::Motor};
constexpr int kMostSeeds = 20;

const char* name_of(Law law) { return law == Law::Ours ? "ours" : "thesis"; }
const char* name_of(firmware::Drive drive) { return drive == firmware::Drive::Stop ? "A" : "B"; }

double rounded(double value) { return std::round(value * 1000) / 1000; }

nlohmann::ordered_json json_of(bool has, double value) {
  return has ? nlohmann::ordered_json(rounded(value)) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const Row& row) {
  return {
      {"law", name_of(row.law)},
      {"drive", name_of(row.drive)},
      {"hand", row.hand.name},
      {"largest_stable_n_per_mm",
       json_of(row.largest_stable_n_per_mm > 0 || row.drive == firmware::Drive::Motor,
               row.largest_stable_n_per_mm)},
      {"free_space_n", json_of(row.has_free_space, row.free_space_n)},
      {"penetration_mm_at_2n", json_of(row.has_penetration, row.penetration_mm_at_2n)},
      {"penetration_worst_mm_at_2n", json_of(row.has_penetration, row.penetration_worst_mm_at_2n)},
      {"energy_returned_mj", rounded(row.energy_returned_mj)},
      {"pull_back_n", rounded(row.pull_back_n)},
      {"limit_cycle", row.limit_cycle}};
}

void print_number(bool has, double value) {
  if (has) {
    std::printf(" %9.2f", value);
  } else {
    std::printf(" %9s", "-");
  }
}

void print(const Row& row) {
  std::printf("%-7s %-5s %-10s", name_of(row.law), name_of(row.drive),
              std::string(row.hand.name).c_str());
  print_number(row.largest_stable_n_per_mm > 0 || row.drive == firmware::Drive::Motor,
               row.largest_stable_n_per_mm);
  print_number(row.has_free_space, row.free_space_n);
  print_number(row.has_penetration, row.penetration_mm_at_2n);
  print_number(row.has_penetration, row.penetration_worst_mm_at_2n);
  std::printf(" %9.2f %9.2f  %s\n", row.energy_returned_mj, row.pull_back_n,
              row.limit_cycle ? "yes" : "no");
}

}  // namespace

void add_device_bench_options(CLI::App& command, DeviceBenchArguments& arguments) {
  command
      .add_option("--seeds", arguments.seeds,
                  "Specimens of every part to try; the worst of them counts")
      ->capture_default_str();
  command.add_option("--json", arguments.json, "Write the figures to this file")
      ->check(output_file());
  command.add_option("--plot", arguments.plot, "Draw a touch by each law and drive to this SVG")
      ->check(output_file());
}

void run_device_bench(const DeviceBenchArguments& arguments,
                      const std::string& firmware,
                      const device_bench::BoardMaker& board) {
  if (arguments.seeds < 1 || arguments.seeds > kMostSeeds) {
    throw UsageError("device bench: --seeds is 1 to " + std::to_string(kMostSeeds));
  }
  std::printf(
      "simulated arms and hands in virtual time, %d specimen(s); drive A's firmware: %s\n\n",
      arguments.seeds, firmware.c_str());
  std::printf("%-7s %-5s %-10s %9s %9s %9s %9s %9s %9s  %s\n", "law", "drive", "hand", "stable",
              "free", "depth", "worst of", "returned", "pulled", "rings at");
  std::printf("%-7s %-5s %-10s %9s %9s %9s %9s %9s %9s  %s\n", "", "", "", "N/mm", "space N",
              "mm at 2 N", "5 ways", "mJ", "back N", "2 N/mm");
  auto rows = nlohmann::ordered_json::array();
  for (const Law law : kLaws) {
    for (const firmware::Drive drive : kDrives) {
      for (const auto& hand : virtual_arm::kHandModels) {
        const Row row = device_bench::measure_row(law, drive, hand, arguments.seeds, board);
        print(row);
        std::fflush(stdout);
        rows.push_back(json_of(row));
      }
    }
  }
  std::printf("\n%-7s %-5s %-48s %10s %10s\n", "law", "drive", "latency", "median us", "worst us");
  auto stages = nlohmann::ordered_json::array();
  for (const Law law : kLaws) {
    for (const firmware::Drive drive : kDrives) {
      for (const Stage& stage : device_bench::measure_latency(law, drive, board)) {
        std::printf("%-7s %-5s %-48s %10.0f %10.0f\n", name_of(law), name_of(drive),
                    stage.name.c_str(), stage.median_us, stage.worst_us);
        stages.push_back({{"law", name_of(law)},
                          {"drive", name_of(drive)},
                          {"stage", stage.name},
                          {"median_us", std::round(stage.median_us)},
                          {"worst_us", std::round(stage.worst_us)}});
      }
    }
  }
  if (!arguments.plot.empty()) {
    records::write_file_atomically(arguments.plot, device_bench_picture(board));
  }
  if (!arguments.json.empty()) {
    const nlohmann::ordered_json figures{{"firmware_of_drive_a", firmware},
                                         {"seeds", arguments.seeds},
                                         {"rows", std::move(rows)},
                                         {"latency", std::move(stages)}};
    records::write_file_atomically(arguments.json, figures.dump(2) + "\n");
  }
}

}  // namespace carpus::cli

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers first: basins by the lowest pass, gradients by their difference. Engines take turns.
#include "bench/imaging/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/imaging/engines.hpp"
#include "bench/imaging/lowest_pass.hpp"
#include "bench/imaging/scans.hpp"
#include "bench/output_file.hpp"
#include "bench/provenance.hpp"

namespace carpus::bench {
namespace {

constexpr double kSigmaMm = 0.3;
/// Of the range of the gradient: the recursive filter approaches the Gaussian, ours samples it.
constexpr double kMostGradientPercent = 2.0;
constexpr int kRounds = 3;

struct Row {
  std::string kernel;
  std::string scan;
  std::string engine;
  double seconds = 0;
  bool agrees = false;
  std::string how;  ///< how far answers agree, in words
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void measure_watershed(const Scan& scan,
                       const std::string& markers_are,
                       const std::vector<std::uint16_t>& markers,
                       std::vector<Row>& rows) {
  struct Engine {
    const char* name;
    WatershedRun (*run)(const Volume&, const std::vector<std::uint16_t>&);
    std::vector<double> seconds;
    std::vector<std::uint16_t> labels;
  };
  std::array<Engine, 3> engines{{{"ours", run_our_watershed, {}, {}},
                                 {"itk_12bit", run_itk_12bit_watershed, {}, {}},
                                 {"itk_float", run_itk_watershed, {}, {}}}};
  for (int round = 0; round < kRounds; ++round) {
    for (Engine& engine : engines) {
      if (round > 0 && engine.seconds.front() > 60) continue;  // minutes a run: once will do
      WatershedRun run = engine.run(scan.volume, markers);
      engine.seconds.push_back(run.seconds);
      engine.labels = std::move(run.labels);
    }
  }
  for (const Engine& engine : engines) {
    const BasinCheck check = check_basins(scan.volume.size, scan.volume.relief_12, markers,
                                          engine.labels, engines.front().labels);
    Row row{"watershed",      scan.name + ", " + markers_are,
            engine.name,      median(engine.seconds),
            check.wrong == 0, ""};
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "%zu wrong, %.3f %% shared otherwise than ours",
                  check.wrong,
                  100 * static_cast<double>(check.other) / static_cast<double>(markers.size()));
    row.how = text.data();
    rows.push_back(row);
  }
}

void measure_gradient(const Scan& scan, std::vector<Row>& rows) {
  std::vector<double> ours;
  std::vector<double> peers;
  GradientRun our_run;
  GradientRun peer_run;
  for (int round = 0; round < kRounds; ++round) {
    our_run = run_our_gradient(scan.volume, kSigmaMm);
    peer_run = run_itk_gradient(scan.volume, kSigmaMm);
    ours.push_back(our_run.seconds);
    peers.push_back(peer_run.seconds);
  }
  double sum = 0;
  for (std::size_t i = 0; i < our_run.values.size(); ++i) {
    sum += std::abs(static_cast<double>(our_run.values[i] - peer_run.values[i]));
  }
  const auto range =
      static_cast<double>(*std::max_element(our_run.values.begin(), our_run.values.end()));
  const double percent = 100 * sum / static_cast<double>(our_run.values.size()) / range;
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.2f %% of the range apart in the mean", percent);
  const bool agrees = percent < kMostGradientPercent;
  rows.push_back({"gradient", scan.name, "ours", median(ours), true, ""});
  rows.push_back({"gradient", scan.name, "itk_recursive", median(peers), agrees, text.data()});
}

/// The bones alone: what lies beyond them is no body.
void measure_surfaces(const Scan& scan, std::vector<Row>& rows) {
  std::vector<std::uint16_t> labels = run_our_watershed(scan.volume, scan.dense).labels;
  const auto outside = *std::max_element(labels.begin(), labels.end());
  for (std::uint16_t& label : labels) label = label == outside ? std::uint16_t{0} : label;
  std::vector<double> seconds;
  SurfacesRun ours;
  for (int round = 0; round < kRounds; ++round) {
    ours = run_our_surfaces(scan.volume, labels);
    seconds.push_back(ours.seconds);
  }
  const auto last = static_cast<std::uint16_t>(outside - 1);
  const std::string name = scan.name + ", " + std::to_string(last) + " labels";
  rows.push_back({"surfaces", name, "ours", median(seconds), true, ""});
  const auto vtk = run_vtk_surfaces(scan.volume, labels, last);
  if (!vtk) {
    std::fprintf(stderr, "surfaces by VTK: not run; tools/install all brings its Python module\n");
    return;
  }
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "%zu vertices, %zu facets; ours %zu, %zu", vtk->vertices,
                vtk->facets, ours.vertices, ours.facets);
  // Cubes that may be read in two ways are read in others: a few vertices and facets differ.
  const double apart =
      std::abs(static_cast<double>(vtk->facets) - static_cast<double>(ours.facets));
  rows.push_back({"surfaces", name, "vtk_flying_edges", vtk->seconds,
                  apart < 0.01 * static_cast<double>(ours.facets), text.data()});
}

void print(const std::vector<Row>& rows) {
  std::map<std::string, double> ours;
  for (const Row& row : rows) {
    if (row.engine == "ours") ours[row.kernel + row.scan] = row.seconds;
  }
  std::printf("%-10s %-32s %-16s %10s %8s  %s\n", "kernel", "scan", "engine", "seconds", "ours is",
              "answers");
  for (const Row& row : rows) {
    std::printf("%-10s %-32s %-16s %10.3f %7.1fx  %s%s\n", row.kernel.c_str(), row.scan.c_str(),
                row.engine.c_str(), row.seconds, row.seconds / ours[row.kernel + row.scan],
                row.agrees ? "" : "! ", row.how.c_str());
  }
}

void run(const ImagingArguments& arguments) {
  if (!arguments.json.empty()) check_writable(arguments.json);
  const Provenance p = provenance();
  std::printf(
      "%s\n%s; %s; commit %s\nsimulated scans, voxels of 0.3 mm; one thread, processor time\n\n",
      p.machine.c_str(), p.compiler.c_str(), p.flags.c_str(), p.commit.c_str());
  std::vector<std::array<int, 3>> sizes{{256, 256, 256}, {512, 512, 200}};
  if (arguments.quick) sizes = {{96, 96, 96}};
  std::vector<Row> rows;
  for (const std::array<int, 3>& size : sizes) {
    const Scan scan = make_scan(size, 1);
    measure_watershed(scan, "dense markers", scan.dense, rows);
    measure_watershed(scan, "sparse markers", scan.sparse, rows);
    measure_gradient(scan, rows);
    measure_surfaces(scan, rows);
  }
  print(rows);
  if (arguments.json.empty()) return;
  nlohmann::ordered_json json{{"machine", p.machine}, {"compiler", p.compiler},
                              {"flags", p.flags},     {"commit", p.commit},
                              {"simulated", true},    {"rows", nlohmann::ordered_json::array()}};
  for (const Row& row : rows) {
    json["rows"].push_back({{"kernel", row.kernel},
                            {"case", row.scan},
                            {"engine", row.engine},
                            {"seconds", row.seconds},
                            {"agrees", row.agrees},
                            {"how", row.how}});
  }
  write_text(arguments.json, json.dump(1) + "\n");
}

}  // namespace

void add_imaging(CLI::App& app, ImagingArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("imaging", "Watershed and gradient against ITK, surfaces against VTK");
  command->add_option("--json", arguments.json, "Write the rows to this file");
  command->add_flag("--quick", arguments.quick, "A small scan: to try it; figures mean little");
  command->callback([&arguments] { run(arguments); });
}

}  // namespace carpus::bench

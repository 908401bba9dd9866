// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <vector>

#include "bench/drawing.hpp"
#include "bench/hull/bone_points.hpp"
#include "bench/hull/growth.hpp"
#include "bench/hull/hull_bench.hpp"
#include "bench/hull/hull_json.hpp"
#include "bench/hull/hull_report.hpp"
#include "bench/hull/plot.hpp"
#include "bench/hull/thesis_bones.hpp"
#include "bench/hull/thesis_report.hpp"
#include "bench/hull/thesis_tables.hpp"
#include "bench/output_file.hpp"
#include "bench/provenance.hpp"

namespace carpus::bench {
namespace {

std::vector<HullEngine> all_engines() {
  std::vector<HullEngine> engines = own_hull_engines();
  for (HullEngine& peer : peer_hull_engines()) engines.push_back(std::move(peer));
  return engines;
}

void append(std::vector<HullRow>& rows,
            const PointSet& set,
            const std::vector<HullEngine>& engines,
            const HullBenchOptions& options) {
  std::fprintf(stderr, "%s, %zu points\n", set.name.c_str(), set.points.size());
  const std::vector<HullRow> more = measure_hulls(set, engines, options);
  rows.insert(rows.end(), more.begin(), more.end());
}

/// Of the distributions.
constexpr std::size_t kFewestPoints = 10'000;
constexpr std::size_t kMostPoints = 10'000'000;

/// From the fewest on, two in each decade and at least three, so that growth can be told; of these
/// the ones not below `least`.
std::vector<std::size_t> sizes_between(std::size_t least, std::size_t most) {
  std::vector<std::size_t> sizes;
  for (std::size_t n = kFewestPoints; n <= most; n *= 10) {
    sizes.push_back(n);
    if (n < 1'000'000 && 3 * n <= most) sizes.push_back(3 * n);
  }
  std::erase_if(sizes, [&](std::size_t n) { return n < least; });
  return sizes;
}

/// Of a bone of the parametric wrist, about.
constexpr std::size_t kModelVertices = 4500;

/// Of table 4.1; brute force runs on parts of this bone.
constexpr std::size_t kCapitateRow = 7;

/// Every so many-th point of a bone: what brute force ends on, and the others beside it.
void append_parts(std::vector<HullRow>& rows,
                  const PointSet& bone,
                  const std::vector<HullEngine>& engines,
                  const HullBenchOptions& options) {
  for (const std::size_t count : {50U, 80U, 120U}) {
    PointSet part{bone.name + ", part", {}, bone.origin};
    part.origin.surface_facets = 0;
    part.origin.thesis_points = 0;
    for (std::size_t i = 0; i < count; ++i)
      part.points.push_back(bone.points[i * bone.points.size() / count]);
    append(rows, part, engines, options);
  }
}

struct PlotFile {
  std::filesystem::path file;
  PlotAxis axis;
};

std::vector<PlotFile> plot_files(const HullArguments& a) {
  if (a.plot.empty()) return {};
  return {{a.plot.string() + "_n.svg", PlotAxis::Points},
          {a.plot.string() + "_h.svg", PlotAxis::HullVertices}};
}

/// What would otherwise be found out after minutes.
void check_before_the_run(const HullArguments& a) {
  if (!a.json.empty()) check_writable(a.json);
  for (const PlotFile& plot : plot_files(a)) check_writable(plot.file);
  const std::string asked = std::to_string(a.min_points) + " ";
  const std::string most = "--max-points " + std::to_string(a.max_points);
  if (a.table == "distributions" && !a.bones.empty()) {
    throw CLI::ValidationError("--bones", "the distributions are of random points; leave it out");
  }
  if (a.min_points > a.max_points) {
    throw CLI::ValidationError("--min-points", asked + "is above " + most + "; give both");
  }
  if (sizes_between(a.min_points, a.max_points).empty()) {
    std::string sizes;
    for (const std::size_t n : sizes_between(kFewestPoints, kMostPoints))
      sizes += " " + std::to_string(n);
    throw CLI::ValidationError("--min-points",
                               asked + "to " + most + " holds none of the sizes" + sizes);
  }
}

constexpr const char* kModelWrist = "parametric wrist (simulated)";

/// What was measured, in words.
std::string bones_of(const HullArguments& a, const std::vector<HullRow>& rows) {
  if (a.table == "distributions") {
    const bool has_bone = std::any_of(
        rows.begin(), rows.end(), [](const HullRow& row) { return !row.origin.source.empty(); });
    return has_bone ? std::string("random points, and a scaphoid of the ") + kModelWrist
                    : "random points";
  }
  const bool has_stand_ins = std::any_of(rows.begin(), rows.end(),
                                         [](const HullRow& row) { return row.origin.is_stand_in; });
  return (a.bones.empty() ? kModelWrist : a.bones.string()) +
         (has_stand_ins ? ", with stand-ins" : "");
}

std::string title_of(const std::string& table) {
  if (table == "4.1") return "Figure 4.7 anew: convex hulls of wrist bones, as table 4.1";
  if (table == "4.2") return "Figure 4.8 anew: convex hulls of bones, as table 4.2";
  return table == "bones" ? "Convex hulls of whole bones" : "Convex hulls of distributions";
}

std::vector<HullRow> measure_thesis(std::span<const ThesisRow> table,
                                    const HullArguments& a,
                                    const std::vector<HullEngine>& engines,
                                    const HullBenchOptions& options) {
  std::vector<HullRow> rows;
  const std::vector<PointSet> bones = thesis_bones(table, a.bones);
  for (const PointSet& bone : bones) append(rows, bone, engines, options);
  if (a.table == "4.1") append_parts(rows, bones[kCapitateRow], engines, options);
  return rows;
}

std::vector<HullRow> measure_bones(const std::filesystem::path& folder,
                                   const std::vector<HullEngine>& engines,
                                   const HullBenchOptions& options) {
  std::vector<HullRow> rows;
  if (!folder.empty()) {
    for (const PointSet& set : bones_in(folder)) append(rows, set, engines, options);
  } else {
    for (const BoneId bone : kAllBones)
      append(rows, model_bone(bone, kModelVertices), engines, options);
  }
  return rows;
}

std::vector<HullRow> measure_distributions(const HullArguments& a,
                                           const std::vector<HullEngine>& engines,
                                           const HullBenchOptions& options) {
  std::vector<HullRow> rows;
  const std::vector<std::size_t> sizes = sizes_between(a.min_points, a.max_points);
  for (const std::string& name : distributions()) {
    for (const std::size_t n : sizes) append(rows, make_point_set(name, n, 1), engines, options);
  }
  for (const std::size_t n : sizes) {
    if (n <= 1'000'000) append(rows, model_bone(BoneId::Scaphoid, n), engines, options);
  }
  return rows;
}

void print_head(const std::string& bones) {
  const Provenance p = provenance();
  std::printf(
      "%s\n%s; %s; commit %s\nbones: %s\nmedian processor time of repeated runs, one thread, hull "
      "alone\n\n",
      p.machine.c_str(), p.compiler.c_str(), p.flags.c_str(), p.commit.c_str(), bones.c_str());
}

void run_hull(const HullArguments& a) {
  check_before_the_run(a);
  HullBenchOptions options;
  options.caps = {a.cap_gib << 30U, a.cap_seconds};
  options.budget_seconds = a.budget_seconds;
  const std::vector<HullEngine> engines = all_engines();
  HullReport report;
  report.table = a.table;
  if (a.table == "4.1") report.thesis = thesis_table_4_1();
  if (a.table == "4.2") report.thesis = thesis_table_4_2();
  report.rows = !report.thesis.empty() ? measure_thesis(report.thesis, a, engines, options)
                : a.table == "bones"   ? measure_bones(a.bones, engines, options)
                                       : measure_distributions(a, engines, options);
  report.bones = bones_of(a, report.rows);
  print_head(report.bones);
  std::fputs(text_of(report.rows).c_str(), stdout);
  if (!report.thesis.empty()) std::fputs(thesis_text(report.thesis, report.rows).c_str(), stdout);
  if (a.table == "4.1") {
    const std::size_t whole = report.thesis[kCapitateRow].vertices;
    std::fputs(brute_force_growth_of(report.rows, whole).c_str(), stdout);
  }
  if (a.table == "distributions") std::printf("\n%s", growth_text(report.rows).c_str());
  if (!a.json.empty()) write_text(a.json, json_of(report));
  for (const PlotFile& plot : plot_files(a))
    save_drawing(plot.file,
                 plot_svg(title_of(a.table) + "; " + report.bones, report.rows, plot.axis));
}

}  // namespace

void add_hull(CLI::App& app, HullArguments& a) {
  CLI::App* hull = app.add_subcommand("hull", "Convex hulls: ours against Qhull, CGAL and Bullet");
  hull->add_option("--table", a.table,
                   "bones: 15 bones; distributions: ball, sphere, ...; 4.1, 4.2: the thesis's")
      ->check(CLI::IsMember({"bones", "distributions", "4.1", "4.2"}))
      ->capture_default_str();
  hull->add_option(
      "--bones", a.bones,
      "Folder of <bone>.ply, e.g. cases/demo/bones; default: the parametric wrist (simulated)");
  hull->add_option("--json", a.json, "Also write the rows here");
  hull->add_option("--plot", a.plot, "Also draw PREFIX_n and PREFIX_h, .svg and .png");
  hull->add_option("--min-points", a.min_points, "Of the distributions; from 10000")
      ->check(CLI::Range(kFewestPoints, kMostPoints))
      ->capture_default_str();
  hull->add_option("--max-points", a.max_points, "Of the distributions; up to 10000000")
      ->check(CLI::Range(kFewestPoints, kMostPoints))
      ->capture_default_str();
  hull->add_option("--budget-seconds", a.budget_seconds, "Time for repeating one engine on one set")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str();
  hull->add_option("--cap-seconds", a.cap_seconds, "Longer than this: not run")
      ->capture_default_str();
  hull->add_option("--cap-gib", a.cap_gib, "More memory than this: not run")->capture_default_str();
  hull->callback([&a] { run_hull(a); });
}

}  // namespace carpus::bench

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/collision/cycle_clock.hpp"
#include "bench/collision/report.hpp"
#include "bench/collision/tables.hpp"
#include "bench/drawing.hpp"
#include "bench/output_file.hpp"
#include "bench/provenance.hpp"
#include "core/error.hpp"

namespace carpus::bench {
namespace {

void print_head(const std::string& bones) {
  const Provenance p = provenance();
  const CycleClock clock;
  std::printf("%s\n%s; %s; commit %s\nbones: %s\n", p.machine.c_str(), p.compiler.c_str(),
              p.flags.c_str(), p.commit.c_str(), bones.c_str());
  std::printf(
      "one thread; single queries by the processor's counter, less the %.1f ns that reading it "
      "takes, in steps of %.1f ns,\neach the least of %d passes, to within such a step; ticks by "
      "processor time, each the least of %d passes; !: answers differ\n\n",
      clock.overhead_seconds() * 1e9, clock.resolution_seconds() * 1e9, kQueryPasses, kPasses);
}

std::string title_of(const std::string& table) {
  if (table == "pair") return "Do two convex bodies meet? Warm queries";
  if (table == "cold") return "Do two convex bodies meet? Cold queries";
  if (table == "tick") return "A tick of all pairs of convex bodies";
  if (table == "distance") return "Distance and depth of two convex bodies";
  if (table == "surface") return "Instruments against the bones' surfaces";
  if (table == "growth") return "Do two convex bodies meet? Time against their facets";
  return "Figure 5.3 anew: do two bones' hulls meet? As table 5.1";
}

void run(const CollisionArguments& a) {
  for (const std::filesystem::path& file : {a.json, a.plot}) {
    if (!file.empty()) check_writable(file);
  }
  BenchOptions options;
  options.caps = {a.cap_gib << 30U, a.cap_seconds};
  options.budget_seconds = a.budget_seconds;
  options.pairs = a.pairs;
  options.engines = a.engines;
  std::vector<CollisionRow> rows;
  std::string bones = a.bones.empty() ? "parametric wrist (simulated)" : a.bones.string();
  std::string tail;
  if (a.table == "5.1") {
    rows = thesis_table(a.bones, options);
    tail = thesis_text(rows);
  } else if (a.table == "growth") {
    bones = "random points of an ellipsoid";
    rows = growth_table(options);
    tail = growth_text(rows);
  } else {
    const BoneSet set = load_bones(a.bones);
    bones += ", " + std::to_string(set.bones.size()) + " hulls of " +
             std::to_string(static_cast<int>(set.mean_facets())) + " facets in the mean";
    rows = a.table == "tick"       ? tick_table(set, options)
           : a.table == "distance" ? distance_table(set, options)
           : a.table == "surface"  ? surface_table(set, options)
                                   : pair_table(set, a.table == "cold", options);
  }
  if (rows.empty()) throw InvalidInput("this table has none of the engines named");
  print_head(bones);
  if (a.table != "growth") std::fputs(text_of(rows).c_str(), stdout);
  std::fputs(tail.c_str(), stdout);
  if (!a.json.empty()) write_json(a.json, a.table, bones, rows);
  if (!a.plot.empty()) {
    save_drawing(a.plot, collision_plot_svg(title_of(a.table) + "; " + bones, rows,
                                            a.table == "growth" ? CollisionAxis::Facets
                                            : a.table == "5.1"  ? CollisionAxis::Vertices
                                                                : CollisionAxis::Cases));
  }
}

}  // namespace

void add_collision(CLI::App& app, CollisionArguments& a) {
  CLI::App* verb = app.add_subcommand(
      "collision", "Convex bodies: ours against FCL, libccd, Bullet, GLPK and CLP");
  verb->add_option("--table", a.table,
                   "pair: yes or no, warm; cold: the same, cold; tick: all pairs of all bones; "
                   "distance: distances and depths; 5.1: the thesis's; growth: against facets; "
                   "surface: all instruments against the true bones")
      ->check(CLI::IsMember({"pair", "cold", "tick", "distance", "5.1", "growth", "surface"}))
      ->capture_default_str();
  verb->add_option(
      "--bones", a.bones,
      "Folder of <bone>.ply, e.g. cases/demo/bones; default: the parametric wrist (simulated)");
  verb->add_option("--json", a.json, "Also write the rows here");
  verb->add_option("--plot", a.plot, "Also draw this SVG, and the PNG beside it");
  verb->add_option("--budget-seconds", a.budget_seconds, "Time for one engine on one case")
      ->check(CLI::Range(0.1, 600.0))
      ->capture_default_str();
  verb->add_option("--pairs", a.pairs, "At most so many pairs of bones; 0: all that are near")
      ->capture_default_str();
  verb->add_option("--engines", a.engines,
                   "Only these, e.g. --engines lp_growth fcl; default: all");
  verb->add_option("--cap-seconds", a.cap_seconds, "Longer than this: not run")
      ->capture_default_str();
  verb->add_option("--cap-gib", a.cap_gib, "More memory than this: not run")->capture_default_str();
  verb->callback([&a] { run(a); });
}

}  // namespace carpus::bench

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/study_axes_command.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "procedures/built_in.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct StudyAxesArguments {
  std::vector<std::string> cases{kDefaultCase};
  std::string json;
};

constexpr double kCountersinkMm = 2.0;  // of bone over the tail [clinical: K, B1 step 9]

/// An operation that did everything rightly and laid a screw along this line, its tail 2 mm deep.
procedure::OperationRecord laid_along(const procedure::Procedure& procedure,
                                      const cases::AxisSegment& line,
                                      instruments::InstrumentIndex screw) {
  procedure::OperationRecord record;
  procedure::LineFacts lain;
  lain.instrument = screw;
  lain.in_target = true;
  lain.entry_in_bone = line.proximal;
  lain.direction_in_bone = normalized_or(line.distal - line.proximal, {0, 0, 1});
  lain.depth_mm = kCountersinkMm + instruments::catalogue()[screw].length_mm;
  record.lines = {lain};
  procedure::Pass pass;
  pass.instrument = procedure.tray.front();
  record.passes = {pass};
  record.reamed_mm = distance(line.proximal, line.distal) - kCountersinkMm;
  for (const bool of_screw : {false, true}) {
    for (const procedure::NamedView& view : procedure.views) {
      procedure::Shot shot;
      shot.rotation_deg = view.rotation_deg;
      shot.tilt_deg = view.tilt_deg;
      shot.shows_wire = !of_screw;
      shot.shows_screw = of_screw;
      record.shots.push_back(shot);
    }
  }
  record.completed_steps = (1U << procedure.steps.size()) - 1U;
  record.finished = true;
  return record;
}

/// The longest screw on the tray that leaves 2 mm at either end of the line.
std::optional<instruments::InstrumentIndex> screw_for(const procedure::Procedure& procedure,
                                                      double line_mm) {
  std::optional<instruments::InstrumentIndex> best;
  const auto all = instruments::catalogue();
  for (const instruments::InstrumentIndex index : procedure.tray) {
    const instruments::Instrument& one = all[index];
    if (one.work != instruments::Work::Thread || one.length_mm > line_mm - 2 * kCountersinkMm) {
      continue;
    }
    if (!best || one.length_mm > all[*best].length_mm) best = index;
  }
  return best;
}

nlohmann::json line_json(const cases::CaseData& data,
                         const procedure::Procedure& procedure,
                         const cases::AxisSegment& line) {
  const double line_mm = distance(line.proximal, line.distal);
  nlohmann::json json = {{"length_mm", line_mm}};
  const auto screw = screw_for(procedure, line_mm);
  if (!screw) return json;
  const procedure::ScoreReport report = procedure.score(data, laid_along(procedure, line, *screw));
  json["screw"] = instruments::catalogue()[*screw].id;
  json["safe"] = report.is_fixation_acceptable;
  json["overall"] = report.overall;
  for (const procedure::ScoreItem& item : report.items) {
    if (item.value) json["items"][item.id] = *item.value;
  }
  return json;
}

void print_line(const char* name, const nlohmann::json& line) {
  const auto item = [&](const char* id) {
    const auto items = line.find("items");
    return items != line.end() && items->contains(id) ? (*items)[id].get<double>() : std::nan("");
  };
  std::printf(
      "  %-14s %5.1f mm  waist %4.1f %%  proximal %4.1f %%  distal %4.1f %%  beside %4.1f mm"
      "  %s %5.1f\n",
      name, line["length_mm"].get<double>(), item("waist_offset_percent"),
      item("proximal_offset_percent"), item("distal_offset_percent"), item("bone_beside_screw_mm"),
      line.value("safe", false) ? "safe    " : "NOT safe", line.value("overall", 0.0));
}

void run(const StudyAxesArguments& arguments) {
  const procedure::Procedure* procedure = procedures::built_in().all().front();
  nlohmann::json rows = nlohmann::json::array();
  std::printf(
      "A screw along the widest cylinder's axis and along the longest line, %s\n"
      "Published central axes: men 27.1 +- 1.0, women 23.9 +- 0.4 mm (SEM) [S45]\n",
      procedure->id.c_str());
  for (const std::string& folder : arguments.cases) {
    const cases::CaseData data = load_case(folder);
    const cases::ScaphoidLandmarks& marks = data.scaphoid;
    const Vec3 axis = marks.central_axis.distal - marks.central_axis.proximal;
    const Vec3 longest = marks.longest_line.distal - marks.longest_line.proximal;
    const double angle_deg =
        degrees_from_radians(std::atan2(length(cross(axis, longest)), dot(axis, longest)));
    std::printf("%s, between them %.1f degrees\n", in_words(data).c_str(), angle_deg);
    nlohmann::json row = {{"case", data.pseudonym},
                          {"case_simulated", data.provenance.simulated},
                          {"angle_between_deg", angle_deg},
                          {"central_axis", line_json(data, *procedure, marks.central_axis)},
                          {"longest_line", line_json(data, *procedure, marks.longest_line)}};
    print_line("central axis", row["central_axis"]);
    print_line("longest line", row["longest_line"]);
    rows.push_back(std::move(row));
  }
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, nlohmann::json({{"rows", rows}}).dump(2) + "\n");
  }
}

}  // namespace

void add_study_axes_command(CLI::App& study) {
  auto arguments = std::make_shared<StudyAxesArguments>();
  CLI::App* command = study.add_subcommand(
      "axes", "The scaphoid's central axis and longest line, and what a screw along each scores");
  command->add_option("--cases", arguments->cases, "Case folders")->capture_default_str();
  command->add_option("--json", arguments->json, "Write the figures to this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/operation_files.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "arthroscopy/make_map.hpp"
#include "arthroscopy/portal_table.hpp"
#include "case_io/case_folder.hpp"
#include "case_io/soft_tissue_folder.hpp"
#include "cases/find_structure.hpp"
#include "cases/make_hand_motion.hpp"
#include "cases/reduced_scaphoid.hpp"
#include "core/error.hpp"
#include "procedures/built_in.hpp"
#include "protocol/bodies.hpp"
#include "reconstruct/skin_surface.hpp"
#include "records/atomic_file.hpp"
#include "session/score_message.hpp"

namespace carpus::cli {

namespace {

std::string measured(const std::optional<double>& value, const char* unit) {
  if (!value) return "not measured";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f %s", *value, unit);
  return text.data();
}

std::string length_lines(const procedure::ScoreReport& report) {
  return "central axis: " + measured(report.central_axis_length_mm, "mm") +
         "\nlongest line through the bone: " + measured(report.longest_line_mm, "mm") +
         ", angle to it: " + measured(report.angle_to_longest_line_deg, "deg") +
         "\ntrue length along the wire: " + measured(report.true_length_mm, "mm") +
         ", gauge reading: " + measured(report.gauge_reading_mm, "mm") + "\n";
}

}  // namespace

namespace {

/// A case of an older program goes on without what it never had, and says what.
void warn_of_lacking(const cases::CaseData& data, const std::filesystem::path& folder) {
  for (const arthroscopy::TabledPortal& portal : arthroscopy::PortalTable::generic().portals) {
    const std::string lacking = cases::lacking(data.structures, portal.needs);
    if (lacking.empty()) continue;
    std::fprintf(stderr,
                 "carpus: this case offers no %s, for it lacks: %s; 'carpus soft-tissue %s' adds "
                 "what is missing\n",
                 portal.name.c_str(), lacking.c_str(), folder.c_str());
  }
}

}  // namespace

cases::CaseData load_case(const std::filesystem::path& folder) {
  cases::CaseData data = case_io::read_case(folder);
  data.skin = reconstruct::trimmed_skin(data.skin, data.ct.geometry());
  cases::ensure_hand_motion(data);
  data.reduced = cases::find_reduced_scaphoid(data);
  if (const auto tissue = case_io::read_soft_tissue(folder)) {
    warn_of_lacking(data, folder);
    data.arthroscopy =
        std::make_shared<const cases::ArthroscopicMap>(arthroscopy::make_map(data, *tissue));
  }
  return data;
}

const procedure::Procedure& find_procedure(const std::string& id) {
  const procedure::ProcedureList& offered = procedures::built_in();
  if (const procedure::Procedure* found = offered.find(id)) return *found;
  std::string known;
  for (const procedure::Procedure* each : offered.all()) {
    known += (known.empty() ? "" : ", ") + each->id;
  }
  throw InvalidInput("there is no procedure '" + id + "'; there are: " + known);
}

simulation::Recording load_recording(const std::filesystem::path& file) {
  Result<simulation::Recording> recording = simulation::decode(records::read_file(file));
  if (!recording) {
    throw IoError(file.string() + ": this is no whole recording: " + recording.error() +
                  "; export it again with 'carpus attempts --export'");
  }
  return std::move(*recording);
}

simulation::Replay replay_on_its_case(const cases::CaseData& data,
                                      const simulation::Recording& recording,
                                      const std::function<void(const simulation::Snapshot&)>& see) {
  simulation::Replay replay =
      simulation::replay(data, find_procedure(recording.procedure), recording, see);
  if (!replay.case_matches) {
    throw InvalidInput("the recording was made on another case than '" + data.pseudonym +
                       "', or on another version of it; name the right one with --case");
  }
  return replay;
}

std::string simulated_mark(bool is_simulated) { return is_simulated ? " (simulated)" : ""; }

std::string in_words(const cases::CaseData& data) {
  return "'" + data.pseudonym + "'" + simulated_mark(data.provenance.simulated);
}

std::string score_table(const procedure::ScoreReport& report) {
  std::string table;
  std::array<char, 512> line{};
  const auto add = [&] { table += line.data(); };
  for (const procedure::ScoreItem& item : report.items) {
    std::array<char, 32> value{"-"};
    if (item.value) std::snprintf(value.data(), value.size(), "%.2f", *item.value);
    std::snprintf(line.data(), line.size(), "%-44.44s %9s %-7.7s %-12s %5.1f / %-5.1f %s\n",
                  item.label.c_str(), value.data(), item.unit == "1" ? "" : item.unit.c_str(),
                  std::string(procedure::name_of(item.grade)).c_str(), item.points,
                  item.points_possible, item.target.c_str());
    add();
    if (!item.reason.empty()) table += "    " + item.reason + "\n";
    if (!item.mark.empty()) table += "    Limits: " + item.mark + "\n";
  }
  for (const procedure::MustHave& must : report.must_haves) {
    std::snprintf(line.data(), line.size(), "must have: %-60.60s %s\n", must.label.c_str(),
                  must.fulfilled      ? "yes"
                  : must.not_measured ? "not judged"
                                      : "NO");
    add();
  }
  // An operation that goes along no bone has none of these.
  if (report.central_axis_length_mm > 0) {
    table += length_lines(report);
    std::snprintf(line.data(), line.size(), "screw chosen: %s, ideal: %s\n",
                  report.chosen_screw.empty() ? "none" : report.chosen_screw.c_str(),
                  report.ideal_screw.empty() ? "none" : report.ideal_screw.c_str());
    add();
  }
  std::snprintf(line.data(), line.size(), "overall %.1f of 100, %s\n", report.overall,
                report.is_fixation_acceptable ? "acceptable" : "not acceptable");
  add();
  return table;
}

std::string score_file(const cases::CaseData& data, const procedure::ScoreReport& report) {
  auto json = nlohmann::ordered_json::parse(
      protocol::serialize_stored_score(session::score_message(report)));
  json["case"] = data.pseudonym;
  json["case_simulated"] = data.provenance.simulated;
  return json.dump(2) + "\n";
}

}  // namespace carpus::cli

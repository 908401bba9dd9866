// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/pathology_table.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "anatomy/bone_id.hpp"
#include "core/error.hpp"

namespace carpus::data {
std::string_view pathology();
}

namespace carpus::arthroscopy {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, cases::kLesionLooks> kLooks{
    "stain", "tear", "worn", "soft", "fissured", "frayed", "bare", "loose"};

[[noreturn]] void refuse(const std::string& what) { throw InvalidInput("pathology.json: " + what); }

void check_bone(const std::string& name, const std::string& where) {
  if (!bone_of(name)) refuse(where + ": there is no bone " + name);
}

cases::LesionLook look_from(const std::string& look, const std::string& where) {
  const auto* const found = std::find(kLooks.begin(), kLooks.end(), look);
  if (found == kLooks.end()) refuse(where + ": nothing shows as " + look);
  return static_cast<cases::LesionLook>(found - kLooks.begin());
}

PatchBeside beside_from(const Json& json, const std::string& where) {
  PatchBeside beside{json.at("near"), json.at("on"), json.value("radially_mm", 0.0),
                     look_from(json.at("shows"), where), json.at("radius_mm")};
  check_bone(beside.on, where);
  if (!(beside.radius_mm > 0)) refuse(where + ": what shows has a radius");
  return beside;
}

Grade grade_from(const Json& json, const std::string& where) {
  Grade g;
  g.id = json.at("id");
  g.label = json.at("label");
  g.length_mm = json.value("length_mm", 0.0);
  g.radius_mm = json.value("radius_mm", 0.0);
  g.distal_radius_mm = json.value("distal_radius_mm", 0.0);
  g.gap_mm = json.value("gap_mm", 0.0);
  g.step_mm = json.value("step_mm", 0.0);
  g.passes_mm = json.value("passes_mm", 0.0);
  g.is_drawn = json.value("is_drawn", true);
  g.more_than = json.value("more_than", "");
  if (json.contains("beside")) g.beside = beside_from(json.at("beside"), where + " " + g.id);
  if (!json.contains("shows")) return g;
  g.shows = look_from(json.at("shows"), where);
  if (!(g.radius_mm > 0)) refuse(where + " " + g.id + ": what shows has a radius");
  return g;
}

Scale scale_from(const Json& json) {
  Scale s;
  s.id = json.at("id");
  s.name = json.at("name");
  s.is_ordered = json.at("is_ordered");
  for (const Json& each : json.at("grades")) s.grades.push_back(grade_from(each, s.id));
  if (s.grades.size() < 2 || s.grades.front().shows) {
    refuse(s.id + ": begins with what is well, and has another grade");
  }
  const auto is_drawn = [](const Grade& g) { return g.is_drawn; };
  if (!std::is_partitioned(s.grades.begin(), s.grades.end(), is_drawn) || s.drawn() == 0) {
    refuse(s.id + ": grades that are drawn stand first, and there is one that is wrong");
  }
  for (const Grade& g : s.grades) {
    const bool is_known = std::any_of(s.grades.begin(), s.grades.end(),
                                      [&](const Grade& other) { return other.id == g.more_than; });
    if (!g.more_than.empty() && !is_known) refuse(s.id + ": there is no grade " + g.more_than);
  }
  return s;
}

Finding finding_from(const Json& json, const std::vector<Scale>& scales) {
  Finding f;
  f.id = json.at("id");
  f.label = json.at("label");
  f.chance = json.value("chance", 0.0);
  const std::string scale = json.at("scale");
  const auto found = std::find_if(scales.begin(), scales.end(),
                                  [&](const Scale& each) { return each.id == scale; });
  if (found == scales.end()) refuse(f.id + ": there is no scale " + scale);
  f.scale = static_cast<std::size_t>(found - scales.begin());
  if (!(f.chance >= 0 && f.chance <= 1)) refuse(f.id + ": a chance is 0 to 1");
  if (json.contains("line")) {
    const Json& line = json.at("line");
    f.line = TornLine{line.at("radiocarpal"), line.at("midcarpal"), line.at("moves"),
                      line.at("away_from").get<std::vector<std::string>>()};
    check_bone(f.line->moves, f.id);
    for (const std::string& bone : f.line->away_from) check_bone(bone, f.id);
  }
  f.at = json.value("at", "");
  if (json.contains("in")) f.among = json.at("in").get<std::vector<std::string>>();
  return f;
}

/// Findings are known by now, of which a grade may go with another.
void read_with(const Json& json, PathologyTable& table) {
  for (std::size_t s = 0; s < table.scales.size(); ++s) {
    for (std::size_t g = 0; g < table.scales[s].grades.size(); ++g) {
      const Json& grade = json.at("scales").at(s).at("grades").at(g);
      if (!grade.contains("with")) continue;
      const std::string finding = grade.at("with").at("finding");
      const std::string id = grade.at("with").at("grade");
      for (std::size_t f = 0; f < table.findings.size(); ++f) {
        const std::vector<Grade>& grades = table.scale_of(f).grades;
        const auto found = std::find_if(grades.begin(), grades.end(),
                                        [&](const Grade& each) { return each.id == id; });
        if (table.findings[f].id != finding || found == grades.end()) continue;
        table.scales[s].grades[g].with =
            WithGrade{f, static_cast<std::uint8_t>(found - grades.begin())};
      }
      if (!table.scales[s].grades[g].with) refuse("there is no " + finding + " " + id);
    }
  }
}

void read_questions(const Json& json, PathologyTable& table) {
  for (const Json& each : json.at("scales")) table.scales.push_back(scale_from(each));
  for (const Json& each : json.at("findings")) {
    table.findings.push_back(finding_from(each, table.scales));
  }
  if (table.findings.size() > cases::kMaxFindings) refuse("too many findings");
  read_with(json, table);
}

}  // namespace

std::size_t Scale::drawn() const {
  const auto all = std::count_if(grades.begin(), grades.end(),
                                 [](const Grade& grade) { return grade.is_drawn; });
  return static_cast<std::size_t>(all - 1);
}

PathologyTable PathologyTable::parse_questions(std::string_view json_text) {
  PathologyTable table;
  try {
    read_questions(Json::parse(json_text), table);
  } catch (const Json::exception& error) {
    throw InvalidInput(std::string("what is asked: ") + error.what());
  }
  return table;
}

PathologyTable PathologyTable::parse(std::string_view json_text) {
  PathologyTable table;
  try {
    const Json json = Json::parse(json_text);
    table.full_traction_n = json.at("opened_by_n").at("value");
    table.healthy_share = json.at("healthy_share").at("value");
    read_questions(json, table);
  } catch (const Json::exception& error) {
    throw InvalidInput(std::string("pathology.json: ") + error.what());
  }
  if (!(table.full_traction_n > 0)) refuse("opened_by_n: a pull is above 0");
  return table;
}

const PathologyTable& PathologyTable::generic() {
  static const PathologyTable kTable = parse(data::pathology());
  return kTable;
}

}  // namespace carpus::arthroscopy

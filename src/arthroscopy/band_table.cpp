// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/band_table.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json_fields.hpp"

namespace carpus::data {
std::string_view yielding_ligaments();
}

namespace carpus::arthroscopy {
namespace {

constexpr double kGreatest = 1000;  // of any figure, in its unit
constexpr double kGreatestMm = 5;
constexpr double kLeast = 1e-3;

TabledBand band_from(JsonFields& json) {
  TabledBand band;
  band.id = json.text("id");
  band.name = json.text("name");
  band.joint = json.text("joint");
  band.behind = json.text("behind");
  band.ligaments = json.texts_or_none("ligaments");
  if (band.ligaments.empty()) json.refuse("is made of no ligament");
  band.spacing_mm = json.marked_number("spacing_mm", kLeast, kGreatestMm);
  band.whole_n_per_mm = json.marked_number("whole_n_per_mm", kLeast, kGreatest);
  json.refuse_unknown_fields();
  return band;
}

BandGrade grade_from(JsonFields& json) {
  BandGrade grade;
  grade.id = json.text("id");
  if (json.has("press_mm")) grade.press_mm = json.marked_number("press_mm", kLeast, kGreatestMm);
  grade.tension_n_per_mm = json.number("tension_n_per_mm", 0, kGreatest);
  grade.foundation_n_per_mm2 = json.number("foundation_n_per_mm2", kLeast, kGreatest);
  grade.along_share = json.number("along_share", kLeast, 1);
  grade.bulge_mm = json.number("bulge_mm", 0, kGreatestMm);
  grade.edge_share = json.number_or("edge_share", kLeast, 1, 0);
  (void)json.text_or("mark", "");
  json.refuse_unknown_fields();
  return grade;
}

}  // namespace

const BandGrade* BandTable::grade(std::string_view id) const noexcept {
  for (const BandGrade& each : grades) {
    if (each.id == id) return &each;
  }
  return nullptr;
}

const TabledBand* BandTable::band(std::string_view id) const noexcept {
  for (const TabledBand& each : bands) {
    if (each.id == id) return &each;
  }
  return nullptr;
}

BandTable BandTable::parse(std::string_view json_text) {
  constexpr const char* kFile = "yielding_ligaments.json";
  const nlohmann::json root = parse_json_text(json_text, kFile);
  JsonFields json(root, kFile, "table");
  BandTable table;
  (void)json.text("doc");
  (void)json.number("schema_version", 1, 1);
  (void)json.text("fit_mark");
  for (JsonFields& each : json.objects("bands")) table.bands.push_back(band_from(each));
  table.on_wall_mm = json.marked_number("on_wall_mm", kLeast, kGreatestMm);
  table.cartilage_mm = json.marked_number("cartilage_mm", kLeast, kGreatestMm);
  table.aside_share = json.marked_number("aside_share", kLeast, 1);
  table.mass_g_per_mm2 = json.marked_number("mass_g_per_mm2", kLeast, kGreatest);
  table.damping_per_s = json.marked_number("damping_per_s", kLeast, kGreatest);
  for (JsonFields& each : json.objects("grades")) table.grades.push_back(grade_from(each));
  if (table.grades.empty() || table.grades.front().id != "0") json.refuse("grades: the first is 0");
  json.refuse_unknown_fields();
  return table;
}

const BandTable& BandTable::generic() {
  static const BandTable kTable = parse(data::yielding_ligaments());
  return kTable;
}

}  // namespace carpus::arthroscopy

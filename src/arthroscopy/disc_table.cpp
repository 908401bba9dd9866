// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/disc_table.hpp"

#include <nlohmann/json.hpp>

#include "core/json_fields.hpp"

namespace carpus::data {
std::string_view yielding_disc();
}

namespace carpus::arthroscopy {
namespace {

constexpr double kGreatest = 1000;  // of any figure, in its unit
constexpr double kGreatestMm = 5;
constexpr double kLeast = 1e-3;

}  // namespace

DiscTable DiscTable::parse(std::string_view json_text) {
  constexpr const char* kFile = "yielding_disc.json";
  const nlohmann::json root = parse_json_text(json_text, kFile);
  JsonFields json(root, kFile, "table");
  (void)json.text("doc");
  (void)json.number("schema_version", 1, 1);
  DiscTable table;
  table.spacing_mm = json.marked_number("spacing_mm", kLeast, kGreatestMm);
  table.material.along_n_per_mm = json.marked_number("along_n_per_mm", kLeast, kGreatest);
  table.material.foundation_n_per_mm2 =
      json.marked_number("foundation_n_per_mm2", kLeast, kGreatest);
  table.material.mass_g_per_mm2 = json.marked_number("mass_g_per_mm2", kLeast, kGreatest);
  table.material.damping_per_s = json.marked_number("damping_per_s", kLeast, kGreatest);
  JsonFields off = json.object("off_the_fovea");
  table.off_radius_mm = off.marked_number("radius_mm", kLeast, kGreatestMm);
  table.off_left_share = off.marked_number("left_share", kLeast, 1);
  off.refuse_unknown_fields();
  JsonFields published = json.object("published");
  table.published.pressed_whole_mm =
      published.marked_number("pressed_whole_mm", kLeast, kGreatestMm);
  table.published.pressed_off_mm = published.marked_number("pressed_off_mm", kLeast, kGreatestMm);
  table.published.rests_off_mm = published.marked_number("rests_off_mm", kLeast, kGreatestMm);
  published.refuse_unknown_fields();
  json.refuse_unknown_fields();
  return table;
}

const DiscTable& DiscTable::generic() {
  static const DiscTable kTable = parse(data::yielding_disc());
  return kTable;
}

}  // namespace carpus::arthroscopy

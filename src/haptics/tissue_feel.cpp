// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/tissue_feel.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"

namespace carpus::data {
std::string_view tissue_feel();
}  // namespace carpus::data

namespace carpus::haptics {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw InvalidInput("tissue_feel.json: " + where + ": " + what);
}

/// Within what a device may be asked for, or a hand can tell.
double number(const Json& from,
              const std::string& where,
              const char* name,
              double least,
              double most) {
  const auto at = from.find(name);
  if (at == from.end() || !at->is_number()) refuse(where, std::string(name) + " is missing");
  const double value = at->get<double>();
  if (!(value >= least && value <= most)) refuse(where, std::string(name) + " cannot be");
  return value;
}

void require_mark(const Json& from, const std::string& where, const char* name = "mark") {
  const auto at = from.find(name);
  if (at == from.end() || !at->is_string() ||
      at->get_ref<const std::string&>().find('[') == std::string::npos) {
    refuse(where, std::string(name) + " is missing");
  }
}

const Json& part(const Json& all, const char* name) {
  const auto at = all.find(name);
  if (at == all.end() || !at->is_object()) refuse(name, "is missing");
  return *at;
}

TissueFeel tissue(const Json& all, const std::string& id) {
  for (const Json& one : all.value("tissues", Json::array())) {
    if (!one.is_object() || one.value("id", "") != id) continue;
    require_mark(one, id);
    return {{number(one, id, "stiffness_n_per_mm", 0.01, 10), number(one, id, "damping_s", 0, 0.01),
             number(one, id, "friction", 0, 1.9)},
            number(one, id, "thickness_mm", 0, 3)};
  }
  refuse(id, "is missing");
}

DrillingFeel drilling(const Json& from) {
  const std::string where = "drilling";
  for (const char* mark : {"thrust_mark", "share_mark", "speed_mark", "slows_mark", "shake_mark"}) {
    require_mark(from, where, mark);
  }
  DrillingFeel feel;
  feel.hardest_bone_n = number(from, where, "hardest_bone_n", 1, 200);
  feel.share_of_peak = number(from, where, "share_of_peak", 0.1, 1);
  feel.turns_per_s = number(from, where, "turns_per_s", 1, 200);
  feel.edges = number(from, where, "edges", 1, 10);
  feel.slows_share = number(from, where, "slows_share", 0, 0.9);
  feel.free_n = number(from, where, "free_n", 0, 1);
  feel.most_n = number(from, where, "most_n", feel.free_n, 1);
  feel.least_cut_share = number(from, where, "least_cut_share", 0, 1);
  return feel;
}

TurningFeel turning(const Json& from) {
  const std::string where = "turning_by_hand";
  require_mark(from, where);
  TurningFeel feel;
  feel.detents_per_turn = number(from, where, "detents_per_turn", 1, 100);
  feel.pulse_ms = number(from, where, "pulse_ms", 1, 100);
  feel.pulse_hz = number(from, where, "pulse_hz", 10, 500);
  feel.least_n = number(from, where, "least_n", 0, 1);
  feel.most_n = number(from, where, "most_n", feel.least_n, 1);
  feel.full_torque_n_mm = number(from, where, "full_torque_n_mm", 1, 2000);
  return feel;
}

}  // namespace

FeelTable read_feel_table(std::string_view text) {
  const Json all = Json::parse(text, nullptr, false);
  if (!all.is_object() || all.value("schema_version", 0) != 1) refuse("it", "is not of version 1");
  FeelTable table;
  table.bone = tissue(all, "bone");
  table.cartilage = tissue(all, "cartilage");
  table.soft_tissue = tissue(all, "soft_tissue");
  const Json& joint = part(all, "joint_gap_mm");
  require_mark(joint, "joint_gap_mm");
  table.joint_gap_mm = number(joint, "joint_gap_mm", "most", 0.1, 10);
  table.drilling = drilling(part(all, "drilling"));
  table.turning = turning(part(all, "turning_by_hand"));
  return table;
}

const FeelTable& feel_table() {
  static const FeelTable kTable = read_feel_table(data::tissue_feel());
  return kTable;
}

}  // namespace carpus::haptics

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/motion_table.hpp"

#include <array>
#include <bit>
#include <cstdio>

#include "core/check.hpp"
#include "geometry/vec3.hpp"
#include "instruments/instrument.hpp"

namespace carpus::cli {
namespace {

constexpr const char* kHeads =
    "time_s,hand,instrument,tip_x_mm,tip_y_mm,tip_z_mm,shaft_x,shaft_y,shaft_z,depth_mm,force_n,"
    "is_touching,is_in_joint,view_x,view_y,view_z,shaft_turn_deg,camera_turn_deg,points_seen\n";

void add(std::string& text, double value, int decimals) {
  std::array<char, 64> word{};
  std::snprintf(word.data(), word.size(), ",%.*f", decimals, value);
  text += word.data();
}

void add(std::string& text, const Vec3& v, int decimals) {
  for (const double value : {v.x, v.y, v.z}) add(text, value, decimals);
}

constexpr int kLengthDecimals = 4;
constexpr int kDirectionDecimals = 6;
constexpr int kAngleDecimals = 2;

/// Of a scope; nothing in those columns otherwise.
void add_view(std::string& text, const simulation::ScopeView& scope, bool holds_it) {
  if (!holds_it) {
    text += ",,,,,,";
    return;
  }
  add(text, scope.axis_in_patient, kDirectionDecimals);
  add(text, scope.shaft_turn_deg, kAngleDecimals);
  add(text, scope.camera_turn_deg, kAngleDecimals);
  text += "," + std::to_string(std::popcount(scope.facts.points_seen));
}

}  // namespace

MotionTable::MotionTable(Tick every) : every_(every), text_(kHeads) { CARPUS_CHECK(every > 0); }

void MotionTable::see(const simulation::Snapshot& now) {
  if (now.tick % every_ != 0) return;
  for (std::size_t hand = 0; hand < now.hands.size(); ++hand) {
    const simulation::HandView& view = now.hands[hand];
    if (view.item == simulation::kNoItem) continue;
    const simulation::ItemView& item = now.items[view.item];
    std::array<char, 64> when{};
    std::snprintf(when.data(), when.size(), "%.3f,%zu,", static_cast<double>(now.tick) / 1000.0,
                  hand);
    text_ += when.data() + instruments::catalogue()[item.instrument].id;
    add(text_, item.tip_in_patient, kLengthDecimals);
    add(text_, item.shaft_in_patient, kDirectionDecimals);
    add(text_, item.depth_mm, kLengthDecimals);
    add(text_, length(view.force_in_patient), kLengthDecimals);
    text_ += view.touching ? ",1" : ",0";
    text_ += now.scope.facts.is_in_joint[hand] ? ",1" : ",0";
    add_view(text_, now.scope, now.scope.hand == hand);
    text_ += '\n';
  }
}

}  // namespace carpus::cli

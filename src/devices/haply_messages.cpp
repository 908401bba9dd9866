// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/haply_messages.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/json_nesting.hpp"

namespace carpus::devices {
namespace {

using nlohmann::json;

constexpr int kDeepest = 16;
constexpr double kMmPerM = 1000;
constexpr double kFarthestMm = 1000;
constexpr double kFastestMmPerS = 10'000;
constexpr std::size_t kMostIdBytes = 64;

const json* field(const json* from, const char* name) {
  if (from == nullptr || !from->is_object()) return nullptr;
  const auto found = from->find(name);
  return found == from->end() ? nullptr : &*found;
}

const json* first_of(const json& from, const char* name) {
  const json* list = field(&from, name);
  return list != nullptr && list->is_array() && !list->empty() ? &list->front() : nullptr;
}

bool read(const json* from, const char* name, double& out) {
  const json* value = field(from, name);
  if (value == nullptr || !value->is_number()) return false;
  out = value->get<double>();
  return std::isfinite(out);
}

bool read(const json* from, Vec3& out) {
  return read(from, "x", out.x) && read(from, "y", out.y) && read(from, "z", out.z);
}

bool is_false(const json* from, const char* name) {
  const json* value = field(from, name);
  return value != nullptr && value->is_boolean() && !value->get<bool>();
}

/// Of a grip, of whatever kind; none where it says nothing that can be used.
void read_grip(const json& all, HaplyState& out) {
  for (const char* kind : {"wireless_verse_grip", "verse_grip", "custom_verse_grip"}) {
    const json* state = field(first_of(all, kind), "state");
    const json* turn = field(state, "orientation");
    double w = 0;
    double x = 0;
    double y = 0;
    double z = 0;
    if (!read(turn, "w", w) || !read(turn, "x", x) || !read(turn, "y", y) || !read(turn, "z", z)) {
      continue;
    }
    const double size = w * w + x * x + y * y + z * z;
    if (!(size > 0.5 && size < 2)) continue;
    out.rotation = rotation_from_quaternion(w, x, y, z);
    out.has_rotation = true;
    const json* buttons = field(state, "buttons");
    std::uint32_t bit = 1;
    for (const char* name : {"a", "b", "c"}) {
      const json* one = field(buttons, name);
      if (one != nullptr && one->is_boolean() && one->get<bool>()) out.buttons |= bit;
      bit <<= 1;
    }
    return;
  }
}

}  // namespace

Result<HaplyState> read_haply_state(std::string_view text) {
  if (text.size() > kMostHaplyBytes) return Refusal{"a message of more than 64 KiB"};
  if (nests_deeper_than(text, kDeepest)) return Refusal{"a message nested too deeply"};
  const json all = json::parse(text, nullptr, false);
  if (!all.is_object()) return Refusal{"a message that is no JSON object"};
  HaplyState out;
  const json* device = first_of(all, "inverse3");
  if (device == nullptr) return out;
  const json* id = field(device, "device_id");
  if (id == nullptr || !id->is_string()) return Refusal{"an Inverse3 without its device_id"};
  out.device_id = id->get<std::string>();
  if (out.device_id.empty() || out.device_id.size() > kMostIdBytes) {
    return Refusal{"an Inverse3 with an impossible device_id"};
  }
  const json* status = field(device, "status");
  for (const char* name : {"calibrated", "power_supply", "ready"}) {
    if (is_false(status, name)) out.is_ready = false;
  }
  const json* state = field(device, "state");
  if (const json* cursor = field(state, "cursor_position"); cursor != nullptr) {
    if (!read(cursor, out.position_mm)) return Refusal{"a cursor_position that is no place"};
    out.position_mm *= kMmPerM;
    if (!(length(out.position_mm) < kFarthestMm)) return Refusal{"a cursor_position out of reach"};
    out.has_cursor = true;
  }
  if (const json* cursor = field(state, "cursor_velocity"); cursor != nullptr) {
    if (!read(cursor, out.velocity_mm_s)) return Refusal{"a cursor_velocity that is none"};
    out.velocity_mm_s *= kMmPerM;
    if (!(length(out.velocity_mm_s) < kFastestMmPerS)) return Refusal{"a cursor_velocity too high"};
  }
  read_grip(all, out);
  return out;
}

std::string haply_force_message(const std::string& device_id, const Vec3& force_n) {
  const json vector{{"x", force_n.x}, {"y", force_n.y}, {"z", force_n.z}};
  const json command{{"set_cursor_force", {{"vector", vector}, {"values", vector}}}};
  const json device{{"device_id", device_id}, {"commands", command}};
  return json{{"inverse3", json::array({device})}}.dump(-1, ' ', false,
                                                        json::error_handler_t::replace);
}

}  // namespace carpus::devices

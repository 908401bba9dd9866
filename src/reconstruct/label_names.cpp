// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/label_names.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "anatomy/bone_id.hpp"
#include "core/error.hpp"
#include "core/json_nesting.hpp"

namespace carpus::reconstruct {
namespace {

nlohmann::json parsed(const std::string& text, const std::string& file) {
  constexpr int kDeepest = 4;  // one would do; more is said to be no number
  if (nests_deeper_than(text, kDeepest)) throw InvalidInput(file + ": nests too deeply");
  std::set<std::string> names;
  std::string twice;
  const auto look = [&](int, nlohmann::json::parse_event_t event, const nlohmann::json& value) {
    if (event == nlohmann::json::parse_event_t::key) {
      const auto name = value.get<std::string>();
      if (!names.insert(name).second) twice = name;
    }
    return true;
  };
  try {
    nlohmann::json json = nlohmann::json::parse(text, look);
    if (!twice.empty()) throw InvalidInput(file + ": '" + twice + "' is there twice");
    return json;
  } catch (const nlohmann::json::exception& problem) {
    throw InvalidInput(file + ": " + problem.what());
  }
}

/// What a simulated scan's own list names besides bones.
bool is_left_out(const std::string& name, const nlohmann::json& value) {
  if (!value.is_number_integer()) return false;
  return (name == "background" && value == 0) ||
         (name == "fracture_gap" && value == kFractureGapLabel);
}

}  // namespace

std::optional<std::uint8_t> label_of_bone(const std::string& name) {
  const std::optional<NamedBone> bone = bone_of(name);
  if (!bone) return std::nullopt;
  return bone->part == BonePart::Distal ? std::uint8_t{kScaphoidDistalLabel}
                                        : static_cast<std::uint8_t>(bone->bone);
}

LabelNumbers parse_label_names(const std::string& text, const std::string& file) {
  const nlohmann::json json = parsed(text, file);
  if (!json.is_object() || json.empty()) {
    throw InvalidInput(file + ": is no list of names such as {\"radius\": 1}");
  }
  LabelNumbers map{};
  for (const auto& [name, value] : json.items()) {
    if (is_left_out(name, value)) continue;
    const auto label = label_of_bone(name);
    if (!label) {
      throw InvalidInput(file + ": there is no bone '" + name +
                         "'; bones are called radius, ulna, scaphoid, scaphoid_proximal, "
                         "scaphoid_distal, lunate, ... metacarpal5");
    }
    const bool is_number = value.is_number_integer() && value >= 1 && value <= 255;
    if (!is_number) {
      throw InvalidInput(file + ": the number of " + name + " is not one from 1 to 255");
    }
    if (std::find(map.begin(), map.end(), *label) != map.end()) {
      throw InvalidInput(file + ": " + name + " is the same bone as another of its names");
    }
    std::uint8_t& to = map[value.get<std::size_t>()];
    if (to != 0) throw InvalidInput(file + ": two bones have the number of " + name);
    to = *label;
  }
  if (map == LabelNumbers{}) throw InvalidInput(file + ": names no bone");
  return map;
}

}  // namespace carpus::reconstruct

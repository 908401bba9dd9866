// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/skin_message.hpp"

#include <algorithm>
#include <cmath>

#include "procedure/aid.hpp"
#include "simulation/asked_portals.hpp"

namespace carpus::session {
namespace {

/// What lies still is told once.
double to_steps(double value, double steps) { return std::round(value * steps) / steps; }
Vec3 to_steps(const Vec3& at, double steps) {
  return {to_steps(at.x, steps), to_steps(at.y, steps), to_steps(at.z, steps)};
}
constexpr double kPlaceSteps = 50.0;  // of a mm
constexpr double kNormalSteps = 200.0;
constexpr double kShareSteps = 50.0;

void replace(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
}

void add_ways(protocol::Skin& message,
              const cases::ArthroscopicMap& map,
              const BodyNames& names,
              const simulation::SkinView& skin) {
  for (std::size_t i = 0; i < skin.way_count; ++i) {
    const simulation::OwnWayView& way = skin.ways[i];
    const cases::Portal& portal = map.portals[way.portal];
    message.ways.push_back({portal.id, portal.name, map.joints[way.joint].id, portal.landmarks,
                            way.skin, way.inwards, way.capsule_mm, names.name(portal.body)});
  }
}

}  // namespace

std::optional<protocol::Skin> skin_message(const cases::CaseData& data,
                                           const BodyNames& names,
                                           const simulation::Snapshot& now) {
  const simulation::SkinView& skin = now.skin;
  if (!skin.is_there) return std::nullopt;
  protocol::Skin message;
  for (std::size_t h = 0; h < simulation::kHands; ++h) {
    protocol::HandOnSkin hand;
    hand.felt = static_cast<protocol::FeltThroughSkin>(skin.feels[h].felt);
    hand.firm_share = std::clamp(to_steps(skin.feels[h].firm_share, kShareSteps), 0.0, 1.0);
    hand.on_skin_mm = to_steps(skin.on_skin[h], kPlaceSteps);
    hand.out_of_skin = to_steps(skin.out_of_skin[h], kNormalSteps);
    hand.under_mm = std::max(0.0, to_steps(skin.under_mm[h], kPlaceSteps));
    hand.is_wet = skin.is_wet[h];
    hand.is_spreading = skin.is_spreading[h];
    message.hands.push_back(hand);
  }
  for (std::size_t i = 0; i < skin.ink_count; ++i) {
    message.ink_mm.push_back(to_steps(skin.ink[i], kPlaceSteps));
  }
  for (std::size_t i = 0; i < skin.cut_count; ++i) {
    const simulation::CutView& cut = skin.cuts[i];
    message.cuts.push_back({to_steps(cut.from_in_patient, kPlaceSteps),
                            to_steps(cut.to_in_patient, kPlaceSteps), cut.is_spread});
  }
  message.made = skin.facts.made;
  if (data.arthroscopy != nullptr) add_ways(message, *data.arthroscopy, names, skin);
  const auto ghost = static_cast<unsigned>(procedure::Aid::Ghost);
  const bool is_asked = (now.aids >> ghost & 1U) != 0;
  if (now.mode == procedure::Mode::Practice && is_asked) {
    message.spot_mm = to_steps(skin.spot, kPlaceSteps);
    message.landmark_mm = to_steps(skin.landmark, kPlaceSteps);
  }
  return message;
}

std::string with_second_portal(std::string text,
                               const cases::CaseData& data,
                               const procedure::Procedure& procedure,
                               std::uint64_t seed) {
  if (!procedure.making || data.arthroscopy == nullptr) return text;
  const auto asked = simulation::asked_portals(data, *procedure.making, seed);
  if (!asked) return text;
  const cases::Portal& second = data.arthroscopy->portals[asked->back()];
  const auto* landmark = procedure::landmark_of(*procedure.making, second.id);
  replace(text, "{second_before_needle}", landmark != nullptr ? landmark->before_needle : "");
  replace(text, "{second_landmarks}", second.landmarks);
  replace(text, "{second}", second.name);
  return text;
}

}  // namespace carpus::session

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What of a tick the exercises with a scope are judged by: where both tips are, what the scope
// sees.
#include "arthroscopy/optics.hpp"
#include "arthroscopy/seen_share.hpp"
#include "core/error.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

namespace {

/// So long in view a place counts as seen from there: more than swept over [E].
constexpr std::uint32_t kInViewTicks = 300;
/// How often it is looked whether the scope sees the other tip.
constexpr Tick kProbeLookTicks = 16;

}  // namespace

/// @throws InvalidInput  where the case lacks one of its places.
detail::DrillPlan detail::drill_plan(const procedure::ScopeDrill& drill,
                                     const cases::ArthroscopicMap& map) {
  const auto places = [&](const std::vector<std::uint8_t>& numbers) {
    DrillPlan::Points points{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      std::size_t at = 0;
      while (at < map.points.size() && map.points[at].number != numbers[i]) ++at;
      if (at == map.points.size()) {
        throw InvalidInput("simulation: the case lacks place " + std::to_string(numbers[i]) +
                           " of the tour, which the exercises go by");
      }
      points[i] = static_cast<std::uint8_t>(at);
    }
    return points;
  };
  return {places(drill.hold), places(drill.touch), places(drill.line),
          arthroscopy::cos_sin_deg(drill.middle_deg)[0]};
}

Vec3 World::State::place_now(const Model& model, std::size_t point) const noexcept {
  const cases::TourPoint& place = model.map->points[point];
  return (poses[place.body] * Point<frame::Bone>{place.at}).v;
}

detail::DrillLook World::State::drill_look(const Model& model,
                                           const Item& scope,
                                           const arthroscopy::Sight& sight) const noexcept {
  detail::DrillLook look;
  look.tip = scope.tip;
  look.is_level = is_level(model, sight);
  look.shaft_turn_deg = scope_state.shaft_turn_deg;
  const auto& points = model.map->points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (scope_state.in_view_ticks[i] >= kInViewTicks) look.places_in_view |= 1U << points[i].number;
  }
  const std::size_t asked = drill_state.done.held;
  if (asked >= model.procedure.drill->hold.size()) return look;
  const std::size_t point = model.drill.hold[asked];
  if ((scope_state.points_in_view >> points[point].number & 1U) == 0) return look;
  const Vec3 way = place_now(model, point) - sight.eye;
  look.has_in_middle = dot(way, sight.axis) >= model.drill.middle_cosine * length(way);
  return look;
}

bool World::State::sees(const Model& model,
                        std::uint8_t joint,
                        const arthroscopy::Sight& sight,
                        const Vec3& tip) const noexcept {
  return arthroscopy::is_in_field(sight, tip) &&
         distance(sight.eye, tip) <= arthroscopy::kUsefulMm &&
         is_clear_to(model, distance(sight.eye, tip)) && is_in_sight(model, joint, sight.eye, tip);
}

void World::State::watch_drill(const Model& model) noexcept {
  if (model.map == nullptr || !model.procedure.drill) return;
  const procedure::ScopeDrill& drill = *model.procedure.drill;
  const Item* probe = nullptr;
  std::uint8_t probing = 0;
  std::uint8_t joint = 0;
  std::optional<arthroscopy::Sight> sight;
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const Item* item = in_hand(h);
    if (item == nullptr || !scope_state.is_in_joint[h]) continue;
    if (const auto looks_out = sight_of(model, *item)) {
      sight = looks_out;
      joint = joint_of(model, scope_state.portal[h]);
      detail::watch_look(drill_state, drill, drill_look(model, *item, *sight));
    } else {
      probe = item;
      probing = h;
    }
  }
  if (!sight) detail::lose_look(drill_state);
  if (probe == nullptr) return detail::lose_probe(drill_state);
  if (spent.tick % kProbeLookTicks == 0) {
    drill_state.is_probe_seen = sight && sees(model, joint, *sight, probe->tip);
  }
  detail::DrillGround ground;
  for (std::size_t i = 0; i < drill.touch.size(); ++i) {
    ground.touch[i] = place_now(model, model.drill.touch[i]);
  }
  for (std::size_t i = 0; i < drill.line.size(); ++i) {
    ground.line[i] = place_now(model, model.drill.line[i]);
  }
  detail::watch_probe(drill_state, drill, ground, {probe->tip, is_held_back(probing, *probe)});
}

}  // namespace carpus::simulation

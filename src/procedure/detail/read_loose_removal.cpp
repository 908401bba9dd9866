// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/detail/read_loose_removal.hpp"

#include "procedure/detail/read_tour_places.hpp"

namespace carpus::procedure::detail {
namespace {

constexpr double kLeastRadiusMm = 0.5;
constexpr double kMostRadiusMm = 2.5;
constexpr std::size_t kMostPlaces = 16;

}  // namespace

LooseRemoval read_loose_removal(JsonFields& fields) {
  LooseRemoval removal;
  const std::vector<double> bodies =
      fields.numbers("bodies", 2, 1, static_cast<double>(kMaxLooseBodies));
  const std::vector<double> radii = fields.numbers("radius_mm", 2, kLeastRadiusMm, kMostRadiusMm);
  if (bodies[0] > bodies[1] || radii[0] > radii[1]) {
    fields.refuse("bodies and radius_mm are given from least to most");
  }
  removal.bodies = {static_cast<std::uint8_t>(bodies[0]), static_cast<std::uint8_t>(bodies[1])};
  removal.radius_mm = {radii[0], radii[1]};
  removal.places = read_tour_places(fields, "places", kMostPlaces);
  if (removal.places.size() < removal.bodies[1]) {
    fields.refuse("places: fewer than bodies, which each lie by one of their own");
  }
  (void)fields.text("mark");
  fields.refuse_unknown_fields();
  return removal;
}

}  // namespace carpus::procedure::detail

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/make_loose_bodies.hpp"

#include <algorithm>
#include <vector>

#include "arthroscopy/pathology_table.hpp"
#include "core/rng.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

using cases::Lesion;
using cases::LesionLook;

constexpr std::uint64_t kStream = 0x7B3;  // apart from other draws of the same seed
constexpr double kAsideMm = 1.5;          // of the place [E]

/// What an examination asks of it.
std::uint8_t finding_of_loose() {
  const PathologyTable& table = PathologyTable::generic();
  for (std::size_t f = 0; f < table.findings.size(); ++f) {
    for (const Grade& grade : table.scale_of(f).grades) {
      if (grade.shows == LesionLook::Loose) return static_cast<std::uint8_t>(f);
    }
  }
  return 0;
}

}  // namespace

cases::JointLesions make_loose_bodies(const cases::CaseData& data,
                                      const cases::ArthroscopicMap& map,
                                      const LooseBodyChoice& choice,
                                      std::uint64_t seed) {
  Rng rng(seed ^ kStream);
  cases::JointLesions made;
  made.shifts.assign(data.bones.size(), {});
  std::vector<const cases::TourPoint*> places;
  for (const cases::TourPoint& point : map.points) {
    const auto& asked = choice.places;
    const auto number = static_cast<std::uint8_t>(point.number);
    if (std::find(asked.begin(), asked.end(), number) != asked.end()) places.push_back(&point);
  }
  const std::uint64_t spread = choice.bodies[1] - choice.bodies[0] + 1U;
  const std::uint64_t count = choice.bodies[0] + rng.below(spread);
  const std::uint8_t finding = finding_of_loose();
  for (std::uint64_t i = 0; i < count && !places.empty(); ++i) {
    const auto at = static_cast<std::ptrdiff_t>(rng.below(places.size()));
    const cases::TourPoint& place = *places[static_cast<std::size_t>(at)];
    places.erase(places.begin() + at);
    const Grid<float>& wall = map.joints[place.joint].wall;
    const Vec3 aside{rng.uniform(-kAsideMm, kAsideMm), rng.uniform(-kAsideMm, kAsideMm),
                     rng.uniform(-kAsideMm, kAsideMm)};
    const fields::DistanceSample near = fields::sample_distance(wall, place.at + aside);
    Lesion body;
    body.look = LesionLook::Loose;
    body.finding = finding;
    body.grade = 1;
    body.joint = place.joint;
    body.body = place.body;
    body.outwards = normalized_or(near.gradient, -map.distal);
    body.radius_mm = rng.uniform(choice.radius_mm[0], choice.radius_mm[1]);
    const Vec3 on_wall =
        near.is_inside_grid ? place.at + aside - body.outwards * near.distance_mm : place.at;
    body.from = body.to = on_wall - body.outwards * (body.radius_mm * kLiesAboveShare);
    made.lesions.push_back(body);
    made.grades[finding] = 1;
  }
  return made;
}

}  // namespace carpus::arthroscopy

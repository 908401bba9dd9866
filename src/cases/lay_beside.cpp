// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/lay_beside.hpp"

#include <utility>
#include <vector>

#include "cases/detail/carried_landmarks.hpp"
#include "cases/detail/stored_digits.hpp"
#include "cases/detail/tube_course.hpp"

namespace carpus::cases {
namespace {

/// The part of a push that each pass takes back, so that it spreads over a centimetre and not over
/// all.
constexpr double kHold = 0.03;

}  // namespace

void lay_structures_beside(CaseData& data, std::span<const TriangleMesh* const> bodies) {
  std::vector<detail::LaidTube> tubes;
  for (const Structure& s : data.structures) {
    detail::LaidTube tube;
    tube.radius_mm = s.radius_mm;
    for (const StructurePoint& p : s.course) tube.drawn.push_back(p.at);
    tube.line = tube.drawn;
    tube.hold.assign(tube.drawn.size(), kHold);
    tubes.push_back(std::move(tube));
  }
  detail::settle(tubes, detail::WristSurfaces(data, bodies), detail::Settling::Wholly);
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    for (std::size_t k = 0; k < tubes[i].line.size(); ++k) {
      const Vec3& now = tubes[i].line[k];
      if (now != tubes[i].drawn[k]) data.structures[i].course[k].at = detail::rounded(now);
    }
  }
}

}  // namespace carpus::cases

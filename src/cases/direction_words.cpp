// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/direction_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace carpus::cases {

std::string direction_in_words(const CaseData& data, const Vec3& in_patient) {
  const Vec3 v = (data.wrist_from_patient * Direction<frame::Patient>{in_patient}).v;
  // Frame Wrist: +x proximal, +z volar, +y ulnar on the left.
  const double ulnar = data.side == Side::Left ? v.y : -v.y;
  std::array<std::pair<double, std::string_view>, 3> parts{{
      {v.z, v.z > 0 ? "volar" : "dorsal"},
      {ulnar, ulnar > 0 ? "ulnar" : "radial"},
      {v.x, v.x > 0 ? "proximal" : "distal"},
  }};
  std::sort(parts.begin(), parts.end(),
            [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  std::string words(parts[0].second);
  if (std::abs(parts[1].first) * 3.0 >= std::abs(parts[0].first)) {
    words += " and ";
    words += parts[1].second;
  }
  return words;
}

}  // namespace carpus::cases

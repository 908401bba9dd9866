// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Portals and tour of the generic wrist as data (data/portals.json).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arthroscopy {

struct TabledPortal {
  std::string id;
  std::string name;
  std::string joint;
  std::string landmarks;
  std::string from;  ///< "lister", or an earlier portal
  double distal_mm = 0;
  double ulnar_mm = 0;
  std::array<double, 2> proximal_deg{};  ///< of the way in, least to most
  std::array<double, 2> search_mm{};     ///< along the forearm, across it
};

/// Exactly one of `on`, `ligament`, `is_disc`.
struct TabledPoint {
  int number = 0;
  std::string id;
  std::string name;
  std::string found_by;
  std::optional<BoneId> on;
  Vec3 at;  ///< frame Wrist of a left wrist [mm]
  std::string ligament;
  double fraction = 0;
  bool is_disc = false;
  bool is_probed = false;
};

struct PortalTable {
  double traction_n = 0;
  std::vector<TabledPortal> portals;
  std::vector<TabledPoint> points;

  /// @throws InvalidInput naming the entry where the text is no such table.
  [[nodiscard]] static PortalTable parse(std::string_view json_text);
  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const PortalTable& generic();
};

}  // namespace carpus::arthroscopy

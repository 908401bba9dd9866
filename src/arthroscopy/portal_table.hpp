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

struct TabledJoint {
  std::string id;  ///< of the soft tissue's space
  std::string name;
  std::array<BoneId, 2> between{};  ///< with which its proximal and its distal wall go
};

struct TabledPortal {
  std::string id;
  std::string name;
  std::string joint;
  std::string landmarks;
  std::string from;  ///< "lister", "radial_styloid", "ulnar_styloid", or an earlier portal
  double distal_mm = 0;
  double ulnar_mm = 0;
  double volar_mm = 0;
  std::array<double, 2> proximal_deg{};  ///< of the way in, least to most
  std::array<double, 2> ulnar_deg{};     ///< likewise about the forearm: 0 volar, 180 dorsal
  bool is_usual = true;                  ///< of the tour; others are offered beside it
  bool is_narrow = false;  ///< a way into it is looked for as finely as into a usual one
  /// Structures between which the way lies, or empty: in order from radial over dorsal to ulnar and
  /// on over volar.
  std::array<std::string, 2> between;
  std::vector<std::string> needs;     ///< structures without which it is not offered
  std::array<double, 2> search_mm{};  ///< along the forearm, across it
  std::string ahead;                  ///< the point that its way leads to, or empty
};

/// Exactly one of `on`, `between`, `ligament`, `is_disc`, `is_place`.
struct TabledPoint {
  int number = 0;
  std::string id;
  std::string name;
  std::string found_by;
  std::string joint;
  std::vector<std::string> by;  ///< ids of portals
  std::optional<BoneId> on;
  std::optional<std::array<BoneId, 2>> between;  ///< where these two come nearest, near `at`
  bool is_place = false;                         ///< whatever lines the joint near `at`
  Vec3 at;                                       ///< frame Wrist of a left wrist [mm]
  std::string ligament;
  double fraction = 0;
  bool is_disc = false;
  bool is_probed = false;
};

struct PortalTable {
  double traction_n = 0;
  std::vector<TabledJoint> joints;
  std::vector<TabledPortal> portals;
  std::vector<TabledPoint> points;

  /// @throws InvalidInput naming the entry where the text is no such table.
  [[nodiscard]] static PortalTable parse(std::string_view json_text);
  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const PortalTable& generic();
};

}  // namespace carpus::arthroscopy

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which ligaments of a joint's wall yield, how stiff they are, and what grades of a tear make of
// them: data/yielding_ligaments.json.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carpus::arthroscopy {

struct TabledBand {
  std::string id;  ///< of the finding that it is told as
  std::string name;
  std::string joint;                   ///< that it is seen from
  std::string behind;                  ///< that its bones' interval opens into
  std::vector<std::string> ligaments;  ///< of data/soft_tissue.json, side by side
  double spacing_mm = 0;               ///< of particles
  double whole_n_per_mm = 0;           ///< of all of them, published
};

struct BandGrade {
  std::string id;
  std::optional<double> press_mm;  ///< by a probe's 1 N, what the rest is fitted to
  double tension_n_per_mm = 0;     ///< of its width
  double foundation_n_per_mm2 = 0;
  double along_share = 1;  ///< of its fibres' stiffness
  double bulge_mm = 0;
  double edge_share = 0;  ///< of what lies under a torn edge
};

struct BandTable {
  std::vector<TabledBand> bands;
  double on_wall_mm = 0;
  double cartilage_mm = 0;  ///< of both bones where they meet
  double aside_share = 0;
  double mass_g_per_mm2 = 0;
  double damping_per_s = 0;
  std::vector<BandGrade> grades;  ///< the first is whole

  /// nullptr: there is none with this id
  [[nodiscard]] const BandGrade* grade(std::string_view id) const noexcept;
  [[nodiscard]] const TabledBand* band(std::string_view id) const noexcept;

  /// @throws InvalidInput naming the entry where the text is no such table.
  [[nodiscard]] static BandTable parse(std::string_view json_text);
  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const BandTable& generic();
};

}  // namespace carpus::arthroscopy

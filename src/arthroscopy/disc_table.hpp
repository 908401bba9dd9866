// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the disc yields, and what was published of it: data/yielding_disc.json.
#pragma once

#include <string_view>

#include "yielding/net_of_sheet.hpp"

namespace carpus::arthroscopy {

struct DiscTable {
  yielding::SheetMaterial material;
  double spacing_mm = 0;      ///< of particles
  double off_radius_mm = 0;   ///< about a tear off the fovea
  double off_left_share = 0;  ///< of what lay under it there

  struct Published {
    double pressed_whole_mm = 0;  ///< in its middle, by a probe's 1 N
    double pressed_off_mm = 0;    ///< the same once it came off the fovea
    double rests_off_mm = 0;      ///< by which its ulnar edge stands off then
  };
  Published published;

  /// @throws InvalidInput naming the entry where the text is no such table.
  [[nodiscard]] static DiscTable parse(std::string_view json_text);
  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const DiscTable& generic();
};

}  // namespace carpus::arthroscopy

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Strands of ligaments between attachments on this case's bones, wrapped over what is in the way,
// and the bands that they make.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "soft_tissue/detail/carried_model.hpp"
#include "soft_tissue/detail/sheet.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue::detail {

struct LaidLigament {
  Ligament ligament;
  Sheet sheet;
};

/// What cannot be attached is named in `problems` and left out.
[[nodiscard]] std::vector<LaidLigament> lay_ligaments(const TissueTable& table,
                                                      const CarriedModel& model,
                                                      const Surroundings& bones,
                                                      std::vector<std::string>& problems);

/// The point moved out of what is in its way until it has so much room.
using WithRoom = std::function<Vec3(const Vec3& point, double room_mm)>;

/// Lets rows of points draw themselves straight, out of what is in their way by their rooms; what
/// is fixed stays. `across` is how much neighbouring rows keep together.
void settle(std::vector<std::vector<Vec3>>& rows,
            const std::vector<std::vector<double>>& room_mm,
            const std::vector<std::vector<bool>>& is_fixed,
            const WithRoom& with_room,
            int passes,
            double across);

}  // namespace carpus::soft_tissue::detail

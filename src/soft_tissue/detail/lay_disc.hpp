// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The articular disc: a sheet from the rim of the radius's sigmoid notch to the ulna's fovea and
// styloid, drawn tight over the ulna's head.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "soft_tissue/detail/carried_model.hpp"
#include "soft_tissue/detail/sheet.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue::detail {

/// Empty where radius or ulna are missing, which `problems` then names.
[[nodiscard]] std::optional<Sheet> lay_disc(const TabledDisc& tabled,
                                            const CarriedModel& model,
                                            const Surroundings& bones,
                                            std::vector<std::string>& problems);

/// The point that shares the way along a line.
[[nodiscard]] Vec3 along_line(const std::vector<Vec3>& line, double share);

}  // namespace carpus::soft_tissue::detail

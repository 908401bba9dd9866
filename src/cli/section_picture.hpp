// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The hand's turn against the moment on it, intact and cut: one panel a direction, the same scales.
#pragma once

#include <string>

#include "soft_tissue/sectioning.hpp"

namespace carpus::cli {

/// SVG. Where no rest was found a curve ends.
[[nodiscard]] std::string section_picture(const soft_tissue::SectioningResult& result,
                                          const soft_tissue::SectioningTable& table);

}  // namespace carpus::cli

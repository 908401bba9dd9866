// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What all charts share: the sheet, notes, and how ours, peers and differing answers are told
// apart - by shape and filling as well as by colour, so that a grey print can be read.
#pragma once

#include <string>
#include <vector>

#include "drawing/svg.hpp"

namespace carpus::bench {

inline constexpr const char* kOwnColour = "#0b5fa5";
inline constexpr const char* kPeerColour = "#c2571a";
inline constexpr const char* kQuietColour = "#777777";
inline constexpr const char* kGridColour = "#dddddd";

using drawing::Anchor;
using drawing::line_from;
using drawing::text_at;
using drawing::TextStyle;

/// `body` on a white sheet with a title, smaller where it would be too wide.
[[nodiscard]] std::string sheet(double width,
                                double height,
                                const std::string& title,
                                const std::string& body);
inline constexpr double kNoteHeight = 17;
/// A line for each note, the first below `top`.
[[nodiscard]] std::string notes_at(double x, double top, const std::vector<std::string>& notes);
/// A circle for ours, a square for a peer; hollow where answers differ.
[[nodiscard]] std::string mark_at(double x,
                                  double y,
                                  double radius,
                                  bool is_peer,
                                  bool agrees,
                                  const char* colour);

}  // namespace carpus::bench

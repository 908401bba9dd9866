// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What all charts share: the sheet, text, and how ours, peers and differing answers are told
// apart - by shape and filling as well as by colour, so that a grey print can be read.
#pragma once

#include <string>
#include <vector>

namespace carpus::bench {

inline constexpr const char* kOwnColour = "#0b5fa5";
inline constexpr const char* kPeerColour = "#c2571a";
inline constexpr const char* kQuietColour = "#777777";
inline constexpr const char* kGridColour = "#dddddd";

enum class Anchor { Start, Middle, End };

struct TextStyle {
  Anchor anchor = Anchor::Start;
  const char* colour = "#222222";
  double size = 12;
  bool is_bold = false;
};

/// `body` on a white sheet with a title, smaller where it would be too wide.
[[nodiscard]] std::string sheet(double width,
                                double height,
                                const std::string& title,
                                const std::string& body);
[[nodiscard]] std::string text_at(double x, double y, const std::string& text, TextStyle style);
[[nodiscard]] std::string line_from(double x1,
                                    double y1,
                                    double x2,
                                    double y2,
                                    const char* colour,
                                    double width = 1);
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

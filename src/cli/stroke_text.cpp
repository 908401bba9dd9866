// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A letter is a word of corners, two digits each: x from 0 to 4, y from 0 to 8, with the baseline
// at 2, small letters up to 6, capitals up to 8; a blank lifts the pen.
#include "cli/stroke_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace carpus::cli {
namespace {

struct Letter {
  char character;
  std::string_view strokes;
};

constexpr std::string_view kUnknown = "0208484202";
constexpr std::array kLetters{
    Letter{' ', ""},
    Letter{'.', "2222"},
    Letter{',', "2211"},
    Letter{':', "2323 2626"},
    Letter{';', "2311 2626"},
    Letter{'-', "1535"},
    Letter{'+', "0545 2327"},
    Letter{'=', "0444 0646"},
    Letter{'/', "0248"},
    Letter{'_', "0141"},
    Letter{'(', "38272332"},
    Letter{')', "18272312"},
    Letter{'0', "120307183847433212"},
    Letter{'1', "172822 1232"},
    Letter{'2', "07183847460242"},
    Letter{'3', "0718384746354443321203 1535"},
    Letter{'4', "32380444"},
    Letter{'5', "480805354443321203"},
    Letter{'6', "473818070312324344351504"},
    Letter{'7', "084812"},
    Letter{'8', "15060718384746351504031232434435"},
    Letter{'9', "031232434738180706153546"},
    Letter{'a', "4642 4536160503123243"},
    Letter{'b', "0802 0516364543321203"},
    Letter{'c', "4536160503123243"},
    Letter{'d', "4842 4536160503123243"},
    Letter{'e', "04444536160503123243"},
    Letter{'f', "48382722 1646"},
    Letter{'g', "4641301001 4536160503123243"},
    Letter{'h', "0802 0516364542"},
    Letter{'i', "2622 2828"},
    Letter{'j', "26211000 2828"},
    Letter{'k', "0802 4604 1542"},
    Letter{'l', "282332"},
    Letter{'m', "0602 05162522 25364542"},
    Letter{'n', "0602 0516364542"},
    Letter{'o', "160503123243453616"},
    Letter{'p', "0600 0516364543321203"},
    Letter{'q', "4640 4536160503123243"},
    Letter{'r', "0602 04152636"},
    Letter{'s', "45361605143443321203"},
    Letter{'t', "27233242 0646"},
    Letter{'u', "0603123243 4642"},
    Letter{'v', "062246"},
    Letter{'w', "0612253246"},
    Letter{'x', "0642 0246"},
    Letter{'y', "0622 4610"},
    Letter{'z', "06460242"},
    Letter{'A', "022842 1434"},
    Letter{'B', "02083847463505 3544433202"},
    Letter{'C', "4738180703123243"},
    Letter{'D', "02082846442202"},
    Letter{'E', "48080242 0535"},
    Letter{'F', "480802 0535"},
    Letter{'G', "473818070312324345 4525"},
    Letter{'H', "0802 4842 0545"},
    Letter{'I', "1838 2822 1232"},
    Letter{'J', "4843321203"},
    Letter{'K', "0802 4804 1542"},
    Letter{'L', "080242"},
    Letter{'M', "0208254842"},
    Letter{'N', "02084248"},
    Letter{'O', "120307183847433212"},
    Letter{'P', "02083847463505"},
    Letter{'Q', "120307183847433212 2442"},
    Letter{'R', "02083847463505 2542"},
    Letter{'S', "473818070615354443321203"},
    Letter{'T', "0848 2822"},
    Letter{'U', "080312324348"},
    Letter{'V', "082248"},
    Letter{'W', "0812253248"},
    Letter{'X', "0842 0248"},
    Letter{'Y', "082548 2522"},
    Letter{'Z', "08480242"},
};

/// Of one step of the letters' grid, for capitals of 1.
constexpr double kStep = 1.0 / 6;

std::string_view strokes_of(char character) {
  const auto found = std::find_if(kLetters.begin(), kLetters.end(),
                                  [&](const Letter& l) { return l.character == character; });
  return found == kLetters.end() ? kUnknown : found->strokes;
}

bool is_narrow(char character) {
  return std::string_view(" .,:;il()").find(character) != std::string_view::npos;
}

/// Steps to the next letter.
double advance_of(char character) {
  if (is_narrow(character)) return 4 * kStep;
  return std::string_view("rft").find(character) != std::string_view::npos ? 5 * kStep : 6 * kStep;
}

}  // namespace

void draw_text(Canvas& canvas,
               double x,
               double baseline,
               double height,
               const Colour& colour,
               std::string_view text) {
  const double step = height * kStep;
  for (const char character : text) {
    const std::string_view strokes = strokes_of(character);
    const double left = is_narrow(character) ? x - step : x;
    const auto corner = [&](std::size_t i) {
      return Vec3{left + (strokes[i] - '0') * step, baseline - (strokes[i + 1] - '2') * step, 0};
    };
    for (std::size_t i = 0; i + 4 <= strokes.size(); i += 2) {
      if (strokes[i + 2] == ' ') {
        ++i;  // the pen is lifted: on to the next word
        continue;
      }
      canvas.stroke(corner(i), corner(i + 2), height * 0.11 + 0.4, colour);
    }
    x += height * advance_of(character);
  }
}

double text_width(double height, std::string_view text) {
  double width = 0;
  for (const char c : text) width += height * advance_of(c);
  return width;
}

}  // namespace carpus::cli

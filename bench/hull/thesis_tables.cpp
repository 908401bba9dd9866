// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/thesis_tables.hpp"

#include <array>
#include <cmath>

namespace carpus::bench {
namespace {

// F = 2V - 4 holds for every closed triangulated hull. Three printed rows break it: the first
// metacarpal (790 for 2 * 379 - 4 = 754), the fibula (1924 for 1824) and the tibia (5301 for 5302).
// Brute force on the first metacarpal is printed 19014.22.1.
constexpr std::array<ThesisRow, 9> kTable41{{
    {"1st Metacarpal", "metacarpal1", BoneId::Metacarpal1, 2179, 4320, 379, 790, 19014.22, 0.66,
     0.61, 0.39, 0.43},
    {"2nd Metacarpal", "metacarpal2", BoneId::Metacarpal2, 1168, 2258, 300, 596, 12015.41, 0.47,
     0.38, 0.33, 0.25},
    {"3rd Metacarpal", "metacarpal3", BoneId::Metacarpal3, 675, 1272, 150, 296, 2330.77, 0.26, 0.22,
     0.15, 0.12, 559},
    {"4th Metacarpal", "metacarpal4", BoneId::Metacarpal4, 532, 1002, 147, 290, 2302.72, 0.21, 0.19,
     0.13, 0.09},
    {"Hamate", "hamate", BoneId::Hamate, 2812, 5620, 394, 784, 19231.20, 0.89, 0.82, 0.67, 0.71},
    {"Ulna", "ulna", BoneId::Ulna, 977, 1864, 312, 620, 12153.03, 0.41, 0.37, 0.32, 0.22},
    {"Scaphoid", "scaphoid", BoneId::Scaphoid, 2890, 5784, 530, 1056, 22125.1, 1.31, 1.22, 1.03,
     0.88, 2539},
    {"Capitate", "capitate", BoneId::Capitate, 3026, 6048, 635, 1266, 25300.35, 1.46, 1.38, 1.31,
     1.25},
    {"Radius", "radius", BoneId::Radius, 2454, 4754, 288, 572, 11260.12, 0.78, 0.72, 0.55, 0.62},
}};

constexpr std::array<ThesisRow, 4> kTable42{{
    {"Fibula", "fibula", BoneId::Metacarpal4, 3732, 7460, 914, 1924, 0, 3.32, 3.01, 2.56, 2.28,
     3662},
    {"Patella", "patella", BoneId::Pisiform, 7058, 14112, 2228, 4452, 0, 10.04, 9.53, 9.15, 9.04},
    {"Tibia", "tibia", BoneId::Ulna, 27342, 54680, 2653, 5301, 0, 46.16, 44.02, 33.19, 30.12},
    {"Femur", "femur", BoneId::Radius, 34716, 69428, 3664, 7324, 0, 83.27, 81.03, 69.89, 63.32,
     32490},
}};

constexpr std::array<PrintedGain, 12> kGains{{
    {"3rd Metacarpal", "gift_wrapping", &ThesisRow::gift_wrapping, 53.87},
    {"3rd Metacarpal", "quickhull", &ThesisRow::quickhull, 42.85},
    {"3rd Metacarpal", "chan", &ThesisRow::chan, 13.33},
    {"Scaphoid", "gift_wrapping", &ThesisRow::gift_wrapping, 32.82},
    {"Scaphoid", "quickhull", &ThesisRow::quickhull, 27.86},
    {"Scaphoid", "chan", &ThesisRow::chan, 14.56},
    {"Fibula", "gift_wrapping", &ThesisRow::gift_wrapping, 31.33},
    {"Fibula", "quickhull", &ThesisRow::quickhull, 24.26},
    {"Fibula", "chan", &ThesisRow::chan, 10.93},
    {"Femur", "gift_wrapping", &ThesisRow::gift_wrapping, 23.96},
    {"Femur", "quickhull", &ThesisRow::quickhull, 21.92},
    {"Femur", "chan", &ThesisRow::chan, 9.4},
}};

/// Of a percentage with two digits, cut off or rounded, from seconds as printed.
constexpr double kRoundingPercent = 0.03;

}  // namespace

double gain_of(const ThesisRow& row, double ThesisRow::*other) {
  return 100 * (1 - row.hybrid / (row.*other));
}

std::vector<PrintedGain> misprinted_gains(std::span<const ThesisRow> table) {
  std::vector<PrintedGain> misprints;
  for (const PrintedGain& gain : kGains) {
    for (const ThesisRow& row : table) {
      if (row.name == gain.bone &&
          std::abs(gain_of(row, gain.other) - gain.percent) > kRoundingPercent) {
        misprints.push_back(gain);
      }
    }
  }
  return misprints;
}

std::span<const ThesisRow> thesis_table_4_1() { return kTable41; }
std::span<const ThesisRow> thesis_table_4_2() { return kTable42; }

}  // namespace carpus::bench

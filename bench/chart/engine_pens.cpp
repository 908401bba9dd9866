// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/engine_pens.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace carpus::bench {
namespace {

/// Dark enough to read as text, and apart in lightness too.
constexpr std::array<const char*, 10> kColours{"#0b5fa5", "#c2571a", "#2a8a57", "#8a2be2",
                                               "#444444", "#a87900", "#d6336c", "#0f8ba3",
                                               "#7a4419", "#5c8a0d"};
constexpr std::array<const char*, 4> kDashes{
    "", " stroke-dasharray=\"9 4\"", " stroke-dasharray=\"2 3\"", " stroke-dasharray=\"10 3 2 3\""};

/// A name's place is its pen: add at the end. Hulls and collisions share no plot, but Bullet.
constexpr std::array<std::string_view, 9> kHulls{"fast",   "quickhull",     "chan",
                                                 "hybrid", "gift_wrapping", "brute_force",
                                                 "qhull",  "cgal",          "bullet"};
/// Those that are as fast as each other stand within ten places.
constexpr std::array<std::string_view, 31> kCollisions{
    "lp_growth", "lp_walk",    "lp_partial", "lp_scan",     "gjk",         "gjk_table",
    "v_clip",    "lin_canny",  "bullet",     "swift",       "fcl",         "fcl_convex",
    "fcl_indep", "libccd_gjk", "libccd_mpr", "glpk",        "clp",         "closest_active_set",
    "q_collide", "ivri",       "quick_cd_6", "quick_cd_14", "quick_cd_18", "quick_cd_26",
    "seidel",    "aabb_tree",  "obb_tree",   "epa",         "depth_exact", "ivri_all_vertices",
    "i_collide"};
static_assert(kHulls[8] == kCollisions[8]);
static_assert(kCollisions.size() <= kColours.size() * kDashes.size());

std::size_t place_of(std::string_view engine) {
  const auto hull = std::find(kHulls.begin(), kHulls.end(), engine);
  if (hull != kHulls.end()) return static_cast<std::size_t>(hull - kHulls.begin());
  const auto collision = std::find(kCollisions.begin(), kCollisions.end(), engine);
  if (collision != kCollisions.end())
    return static_cast<std::size_t>(collision - kCollisions.begin());
  std::uint32_t hash = 2166136261U;  // FNV-1a: the same on every machine
  for (const char c : engine) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash % (kColours.size() * kDashes.size());
}

}  // namespace

Pen pen_of(std::string_view engine) {
  const std::size_t place = place_of(engine);
  return {kColours[place % kColours.size()], kDashes[place / kColours.size() % kDashes.size()]};
}

}  // namespace carpus::bench

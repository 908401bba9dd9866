// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/engine_pens.hpp"

#include <gtest/gtest.h>

#include "bench/chart/curve_chart.hpp"
#include "bench/hull/engine.hpp"
#include "survey/methods.hpp"

namespace carpus::bench {
namespace {

bool is_same(const Pen& a, const Pen& b) {
  return std::string_view(a.colour) == b.colour && std::string_view(a.dash) == b.dash;
}

void expect_apart(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(is_same(pen_of(names[i]), pen_of(names[j]))) << names[i] << ", " << names[j];
  }
}

TEST(EnginePens, HullEnginesDiffer) {
  std::vector<std::string> names{"qhull", "cgal", "bullet"};
  for (const HullEngine& e : own_hull_engines()) names.push_back(e.name);
  expect_apart(names);
}

TEST(EnginePens, CollisionEnginesDiffer) {
  std::vector<std::string> names{"fcl",        "fcl_convex", "fcl_indep",
                                 "libccd_gjk", "libccd_mpr", "bullet",
                                 "glpk",       "clp",        "ivri_all_vertices"};
  for (const survey::Method& m : survey::all_methods()) names.emplace_back(m.name);
  expect_apart(names);
}

/// The colour of its name.
std::string stroke_of(const std::string& svg, const std::string& engine) {
  const std::size_t name = svg.find(">" + engine + "<");
  const std::size_t fill = svg.rfind("fill=\"", name);
  return svg.substr(fill, 14);
}

TEST(EnginePens, OtherCurvesBesideItDoNotChangeACurve) {
  const Curve chan{"chan", false, {{1e4, 0.1, true}, {1e5, 1, true}}};
  const Curve fast{"fast", false, {{1e4, 0.2, true}, {1e5, 2, true}}};
  const std::string alone = curve_chart_svg("a", "n", "median", {{"", {chan}}});
  const std::string both = curve_chart_svg("a", "n", "median", {{"", {fast, chan}}});
  EXPECT_EQ(stroke_of(alone, "chan"), stroke_of(both, "chan"));
  EXPECT_NE(stroke_of(both, "fast"), stroke_of(both, "chan"));
}

}  // namespace
}  // namespace carpus::bench

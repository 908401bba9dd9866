// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "drawing/facets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace carpus::drawing {
namespace {

// The viewer of these stands on the x axis and sees y to the right, z up.
View view_along_x(std::span<const Vec3> seen) { return {seen, {0, 0, 100, 100}, {1, 0, 0}}; }

/// A regular tetrahedron's corners, two of whose faces look along +x.
constexpr std::array kCorners{Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}};

TEST(Facets, NearerOnesArePaintedOverFartherOnes) {
  TriangleMesh two;
  for (const double x : {2.0, 0.0}) {  // the near one first in the mesh
    for (const Vec3& p : {Vec3{x, 0, 0}, Vec3{x, 1, 0}, Vec3{x, 0, 1 + x}})
      two.vertices.push_back(p);
  }
  two.facets = {{0, 1, 2}, {3, 4, 5}};
  const std::string svg = draw_surface(view_along_x(two.vertices), two, {1, 1, 1});
  const std::size_t near = svg.find(" 0.0Z");  // to the very top of the area
  const std::size_t far = svg.find(" 66.7Z");
  ASSERT_NE(near, std::string::npos) << svg;
  EXPECT_LT(far, near) << svg;
}

TEST(Facets, AClosedSurfaceShowsOnlyWhatFacesTheViewer) {
  TriangleMesh solid{{kCorners.begin(), kCorners.end()},
                     {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
  if (volume_of(solid) < 0) {
    for (Triangle& t : solid.facets) std::swap(t[1], t[2]);
  }
  const auto facets_drawn = [&] {
    const std::string svg = draw_surface(view_along_x(solid.vertices), solid, {1, 1, 1});
    std::size_t count = 0;
    for (std::size_t at = svg.find('Z'); at != std::string::npos; at = svg.find('Z', at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(facets_drawn(), 2U);
  solid.facets.pop_back();
  EXPECT_EQ(facets_drawn(), 3U);
}

/// Of a facet across the view, bright at its corner 0 and dark along the side from 1 to 2.
TEST(Facets, NormalsOfVerticesShadeAFacetFromCornerToCorner) {
  const TriangleMesh one{{{0, 0, 0}, {0, 2, 0}, {0, 2, 2}}, {{0, 1, 2}}};
  const View view = view_along_x(one.vertices);
  SurfacePaint paint{[](std::size_t) { return Colour{1, 1, 1}; }};
  EXPECT_EQ(draw_surface(view, one, paint).find("Gradient"), std::string::npos);
  const Vec3 bright{1, 0, 0};
  const Vec3 dark{0, 1, 0};
  const std::array<Vec3, 3> normals{bright, dark, dark};
  paint.normals = normals;
  const std::string svg = draw_surface(view, one, paint);
  const auto stop = [&](const Vec3& normal) {
    return "stop-color=\"" + hex(shaded({1, 1, 1}, view.brightness(normal)));
  };
  const std::size_t first = svg.find(stop(dark));
  ASSERT_NE(first, std::string::npos) << svg;
  EXPECT_GT(svg.find(stop(bright)), first) << svg;
  // The facet fills the page, corner 0 at its lower left: the gradient lies along the page's x.
  EXPECT_THAT(svg, testing::HasSubstr("x1=\"100.0\""));
  EXPECT_THAT(svg, testing::HasSubstr("x2=\"0.0\""));
  const std::array<Vec3, 3> even{bright, bright, bright};
  paint.normals = even;
  EXPECT_EQ(draw_surface(view, one, paint).find("Gradient"), std::string::npos);
  const std::vector<std::array<double, 3>> factors{{1, 0.5, 0.5}};
  paint.factors = factors;
  EXPECT_THAT(
      draw_surface(view, one, paint),
      testing::HasSubstr("stop-color=\"" + hex(shaded({1, 1, 1}, view.brightness(bright) / 2))));
}

TEST(Facets, TheOutlineIsBolderThanTheEdgesWithinIt) {
  const std::array<std::array<std::uint32_t, 3>, 2> corners{{{0, 1, 2}, {0, 2, 3}}};
  const std::array<std::array<std::uint32_t, 3>, 2> beyond{{{2, 2, 1}, {0, 2, 2}}};
  const std::array hidden{0U, 3U, 2U, 1U};
  const std::array over{1U, 1U, 0U, 0U};
  const std::array<Vec3, 4> square{Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 1, 1}, Vec3{0, 0, 1}};
  const Solid flat{square,
                   {{corners[0], beyond[0], {1, 0, 0}},
                    {corners[1], beyond[1], {1, 0, 0}},
                    {hidden, over, {-1, 0, 0}}}};
  const std::string svg = draw_edges(view_along_x(square), flat, {0, 0, 0}, 0.5);
  EXPECT_THAT(svg, testing::HasSubstr("stroke-width=\"1\" stroke-opacity=\"0.5\" "
                                      "stroke-linecap=\"round\" d=\"M100.0 0.0L0.0 100.0\""));
  EXPECT_THAT(svg, testing::HasSubstr("stroke-width=\"2\" stroke-opacity=\"1\" "
                                      "stroke-linecap=\"round\" d=\"M0.0 100.0L100.0 100.0"));
}

TEST(Facets, PointsOnTheSamePlaceAreDrawnOnce) {
  const std::vector<Vec2> points{{4.2, 7}, {3.9, 7.1}, {5, 7}};
  EXPECT_THAT(draw_points(points, {0, 0, 0}), testing::HasSubstr("d=\"M4 7h0M5 7h0\""));
  EXPECT_EQ(draw_points({}, {0, 0, 0}), "");
}

}  // namespace
}  // namespace carpus::drawing

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/cube_cases.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <set>

#include "core/text_format.hpp"
#include "drawing/facets.hpp"
#include "drawing/svg.hpp"
#include "drawing/view.hpp"
#include "mesh/cube_table.hpp"

namespace carpus::figures {
namespace {

using Corners = std::array<std::uint8_t, 8>;  ///< where each corner goes

Vec3 place_of(std::size_t corner) {
  return {static_cast<double>(corner & 1U), static_cast<double>(corner >> 1U & 1U),
          static_cast<double>(corner >> 2U & 1U)};
}

/// A quarter turn about an axis: of the two others, b takes a's place and a, reversed, b's.
Corners quarter_turn(std::size_t axis) {
  const std::size_t a = (axis + 1) % 3;
  const std::size_t b = (axis + 2) % 3;
  Corners to{};
  for (std::size_t c = 0; c < 8; ++c) {
    const std::size_t bit_a = c >> a & 1U;
    const std::size_t bit_b = c >> b & 1U;
    const std::size_t kept = c & (std::size_t{1} << axis);
    to[c] = static_cast<std::uint8_t>(kept | bit_b << a | (1U - bit_a) << b);
  }
  return to;
}

std::uint8_t turned(std::uint8_t inside, const Corners& to) {
  unsigned result = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    if ((inside >> c & 1U) != 0) result |= 1U << to[c];
  }
  return static_cast<std::uint8_t>(result);
}

/// All that turns and complements make of one.
std::set<std::uint8_t> class_of(std::uint8_t inside) {
  std::set<std::uint8_t> found{inside};
  std::vector<std::uint8_t> open{inside};
  while (!open.empty()) {
    const std::uint8_t one = open.back();
    open.pop_back();
    for (std::size_t next = 0; next < 4; ++next) {
      const auto other = next < 3 ? turned(one, quarter_turn(next))
                                  : static_cast<std::uint8_t>(~static_cast<unsigned>(one) & 255U);
      if (found.insert(other).second) open.push_back(other);
    }
  }
  return found;
}

std::string draw_cube(std::uint8_t inside, const drawing::PageArea& area) {
  std::vector<Vec3> corners;
  for (std::size_t c = 0; c < 8; ++c) corners.push_back(place_of(c));
  const drawing::View view(corners, area, {0.35, -0.85, 0.4});
  const mesh::CubeCase& surface = mesh::cube_table()[inside];
  TriangleMesh mesh;
  for (const mesh::CubeEdge& e : mesh::kCubeEdges) {
    mesh.vertices.push_back((place_of(e.low_corner) + place_of(e.high_corner)) * 0.5);
  }
  for (const auto& loop : surface.centred_loops) {
    Vec3 centre;
    for (const std::uint8_t edge : loop) centre = centre + mesh.vertices[edge];
    mesh.vertices.push_back(centre * (1.0 / static_cast<double>(loop.size())));
  }
  for (const auto& t : surface.triangles) mesh.facets.push_back({t[0], t[1], t[2]});
  std::string edges;
  for (const mesh::CubeEdge& e : mesh::kCubeEdges) {
    edges += drawing::line_path(view(corners[e.low_corner]), view(corners[e.high_corner]));
  }
  std::string svg = drawing::strokes(edges, {"#888888", 1.2});
  if (!mesh.facets.empty()) {
    svg += draw_surface(view, mesh,
                        {[](std::size_t) {
                           return drawing::Colour{0.98, 0.78, 0.45};
                         },
                         "#7a4a00", 0.9});
  }
  for (std::size_t c = 0; c < 8; ++c) {
    if ((inside >> c & 1U) != 0) svg += drawing::disc_at(view(corners[c]), 5, "#1f4fa8");
  }
  return svg;
}

}  // namespace

std::vector<std::uint8_t> base_cube_cases() {
  std::vector<std::uint8_t> bases;
  std::set<std::uint8_t> seen;
  for (unsigned inside = 0; inside < 256; ++inside) {
    if (seen.contains(static_cast<std::uint8_t>(inside))) continue;
    const auto members = class_of(static_cast<std::uint8_t>(inside));
    seen.insert(members.begin(), members.end());
    bases.push_back(*std::min_element(members.begin(), members.end(), [](auto a, auto b) {
      return std::popcount(a) != std::popcount(b) ? std::popcount(a) < std::popcount(b) : a < b;
    }));
  }
  std::stable_sort(bases.begin(), bases.end(),
                   [](auto a, auto b) { return std::popcount(a) < std::popcount(b); });
  return bases;
}

std::string draw_cube_cases() {
  constexpr double kPanel = 180;
  constexpr std::size_t kRow = 5;
  const auto bases = base_cube_cases();
  std::string svg;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    const drawing::PageArea area{static_cast<double>(i % kRow) * kPanel + 25,
                                 static_cast<double>(i / kRow) * kPanel + 30, kPanel - 50,
                                 kPanel - 50};
    svg += drawing::text_at(area.left - 12, area.top - 8, format("%zu", i), {.size = 14});
    svg += draw_cube(bases[i], area);
  }
  const std::size_t rows = (bases.size() + kRow - 1) / kRow;
  return drawing::page(kPanel * kRow, kPanel * static_cast<double>(rows), svg);
}

}  // namespace carpus::figures

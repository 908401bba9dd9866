// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Facets whose neighbour lies in the same plane (exactly) get the same face number.
// 2. A vertex is a corner of the polytope iff it touches three faces or more.
// 3. Each face's border is walked, corners only, and fanned from the lowest index.
// 4. Vertices are numbered in input order and facets sorted, so that the result depends on the
//    points only.
#include "hull/detail/finish_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "core/check.hpp"
#include "hull/detail/orientation.hpp"

namespace carpus::hull {
namespace {

using Neighbours = std::vector<std::array<std::uint32_t, 3>>;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Squared lengths of normals between these come from products that neither under- nor overflowed.
constexpr double kLeastSquare = 1e-200;
constexpr double kLargestSquare = 1e200;

std::size_t edge_towards(const std::array<std::uint32_t, 3>& neighbours, std::uint32_t facet) {
  return neighbours[0] == facet ? 0 : (neighbours[1] == facet ? 1 : 2);
}

/// Face number of each facet.
std::vector<std::uint32_t> merge_coplanar(std::span<const Vec3> points,
                                          const std::vector<Triangle>& facets,
                                          const Neighbours& neighbours,
                                          HullStatistics& statistics) {
  std::vector<std::uint32_t> face(facets.size(), kNone);
  std::vector<std::uint32_t> open;
  std::uint32_t count = 0;
  for (std::uint32_t seed = 0; seed < facets.size(); ++seed) {
    if (face[seed] != kNone) continue;
    face[seed] = count;
    open.push_back(seed);
    const Triangle& t = facets[seed];
    while (!open.empty()) {
      const std::uint32_t f = open.back();
      open.pop_back();
      for (const std::uint32_t g : neighbours[f]) {
        if (face[g] != kNone) continue;
        const std::size_t shared = edge_towards(neighbours[g], f);
        const Vec3& opposite = points[facets[g][(shared + 2) % 3]];
        if (counted_orient3d(points[t[0]], points[t[1]], points[t[2]], opposite, statistics) == 0) {
          face[g] = count;
          open.push_back(g);
        }
      }
    }
    ++count;
  }
  return face;
}

/// For each point, whether three or more faces meet there.
std::vector<char> find_corners(std::size_t point_count,
                               const std::vector<Triangle>& facets,
                               const std::vector<std::uint32_t>& face) {
  std::vector<std::array<std::uint32_t, 2>> seen(point_count, {kNone, kNone});
  std::vector<char> is_corner(point_count, 0);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const std::uint32_t v : facets[f]) {
      auto& [first, second] = seen[v];
      if (first == kNone || first == face[f]) {
        first = face[f];
      } else if (second == kNone || second == face[f]) {
        second = face[f];
      } else {
        is_corner[v] = 1;
      }
    }
  }
  return is_corner;
}

/// The corners along the border of the face that holds `facet`, whose edge `edge` is on the border.
std::vector<std::uint32_t> border_of(const std::vector<Triangle>& facets,
                                     const Neighbours& neighbours,
                                     const std::vector<std::uint32_t>& face,
                                     const std::vector<char>& is_corner,
                                     std::uint32_t facet,
                                     std::size_t edge) {
  std::vector<std::uint32_t> corners;
  const std::uint32_t first_facet = facet;
  const std::size_t first_edge = edge;
  do {
    if (is_corner[facets[facet][edge]] != 0) corners.push_back(facets[facet][edge]);
    edge = (edge + 1) % 3;
    while (face[neighbours[facet][edge]] == face[facet]) {  // turn about the edge's start
      const std::uint32_t next = neighbours[facet][edge];
      edge = (edge_towards(neighbours[next], facet) + 1) % 3;
      facet = next;
    }
  } while (facet != first_facet || edge != first_edge);
  return corners;
}

void fan(std::vector<std::uint32_t> corners, std::vector<Triangle>& facets) {
  CARPUS_CHECK(corners.size() >= 3);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    facets.push_back({corners[0], corners[i], corners[i + 1]});
  }
}

/// Sorts facets that begin with their lowest vertex: in buckets by that vertex, of a few facets
/// each.
std::vector<Triangle> sorted(const std::vector<Triangle>& facets, std::size_t vertex_count) {
  std::vector<std::uint32_t> begin(vertex_count + 1, 0);
  for (const Triangle& t : facets) ++begin[t[0] + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> end(begin.begin(), begin.end() - 1);
  std::vector<Triangle> result(facets.size());
  for (const Triangle& t : facets) {
    std::uint32_t at = end[t[0]]++;
    for (; at > begin[t[0]] && result[at - 1] > t; --at) result[at] = result[at - 1];
    result[at] = t;
  }
  return result;
}

/// Whether the facet is a whole face. Its vertices are corners then: about a vertex of two faces
/// only, both would turn by 180 degrees.
bool is_alone(const Neighbours& neighbours,
              const std::vector<std::uint32_t>& face,
              std::uint32_t facet) {
  const auto& [a, b, c] = neighbours[facet];
  return face[a] != face[facet] && face[b] != face[facet] && face[c] != face[facet];
}

std::vector<Triangle> triangulate_faces(std::size_t point_count,
                                        const std::vector<Triangle>& facets,
                                        const Neighbours& neighbours,
                                        const std::vector<std::uint32_t>& face) {
  const std::vector<char> is_corner = find_corners(point_count, facets, face);
  std::vector<char> done(facets.size(), 0);  // by face number
  std::vector<Triangle> result;
  result.reserve(facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    if (done[face[f]] != 0) continue;
    if (is_alone(neighbours, face, f)) {
      done[face[f]] = 1;
      result.push_back(facets[f]);
      continue;
    }
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (face[neighbours[f][edge]] == face[f]) continue;
      done[face[f]] = 1;
      fan(border_of(facets, neighbours, face, is_corner, f, edge), result);
      break;
    }
  }
  return result;
}

}  // namespace

Plane facet_plane(const Vec3& a, const Vec3& b, const Vec3& c, bool contains_corners) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  Plane plane;
  plane.normal = cross(u, v);
  const double square = dot(plane.normal, plane.normal);
  if (square > kLeastSquare && square < kLargestSquare) {
    plane.normal *= 1 / std::sqrt(square);
  } else {  // products under- or overflow: scaled first
    const auto size_of = [](const Vec3& d) {
      return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    };
    const Vec3 normal = cross(u / size_of(u), v / size_of(v));
    plane.normal = normalized_or(normal / size_of(normal), {0, 0, 1});
  }
  plane.offset = dot(plane.normal, a);
  if (contains_corners) {
    plane.offset = std::max({plane.offset, dot(plane.normal, b), dot(plane.normal, c)});
  }
  return plane;
}

std::vector<std::array<std::uint32_t, 3>> neighbours_of(std::span<const Triangle> facets) {
  // Edges in buckets by their lower vertex, of which each has a few; within one the twin is
  // searched.
  std::uint32_t vertices = 0;
  for (const Triangle& t : facets) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  std::vector<std::uint32_t> begin(vertices + 1, 0);
  const auto edge_of = [&](std::size_t f, std::size_t i) {
    return std::pair<std::uint32_t, std::uint32_t>(
        std::minmax(facets[f][i], facets[f][(i + 1) % 3]));
  };
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) ++begin[edge_of(f, i).first + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  struct HalfEdge {
    std::uint32_t higher;
    std::uint32_t facet;
    std::uint32_t edge;
  };
  std::vector<HalfEdge> waiting(facets.size() * 3);
  std::vector<std::uint32_t> end(begin.begin(), begin.end() - 1);  // of those whose twin is to come
  std::vector<std::array<std::uint32_t, 3>> result(facets.size());
  std::size_t pairs = 0;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto [lower, higher] = edge_of(f, i);
      std::uint32_t at = begin[lower];
      while (at < end[lower] && waiting[at].higher != higher) ++at;
      if (at == end[lower]) {
        waiting[end[lower]++] = {higher, f, i};
        continue;
      }
      result[f][i] = waiting[at].facet;
      result[waiting[at].facet][waiting[at].edge] = f;
      waiting[at] = waiting[--end[lower]];
      ++pairs;
    }
  }
  CARPUS_CHECK(2 * pairs == 3 * facets.size());  // closed
  return result;
}

ConvexPolytope finish_hull(std::span<const Vec3> points,
                           std::vector<Triangle> facets,
                           bool planes_contain_vertices,
                           HullStatistics& statistics) {
  Neighbours neighbours = neighbours_of(facets);
  const std::vector<std::uint32_t> face = merge_coplanar(points, facets, neighbours, statistics);
  facets = triangulate_faces(points.size(), facets, neighbours, face);

  ConvexPolytope polytope;
  std::vector<std::uint32_t> renamed(points.size(), kNone);
  for (const Triangle& t : facets) {
    for (const std::uint32_t v : t) renamed[v] = 0;
  }
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (renamed[i] == kNone) continue;
    renamed[i] = static_cast<std::uint32_t>(polytope.vertices.size());
    polytope.vertices.push_back(points[i]);
    polytope.input_indices.push_back(i);
  }
  for (Triangle& t : facets) {
    for (std::uint32_t& v : t) v = renamed[v];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  facets = sorted(facets, polytope.vertices.size());
  polytope.neighbours = neighbours_of(facets);
  polytope.facets = std::move(facets);
  polytope.planes.reserve(polytope.facets.size());
  for (const Triangle& t : polytope.facets) {
    polytope.planes.push_back(facet_plane(polytope.vertices[t[0]], polytope.vertices[t[1]],
                                          polytope.vertices[t[2]], planes_contain_vertices));
  }
  return polytope;
}

}  // namespace carpus::hull

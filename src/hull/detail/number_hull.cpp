// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Vertices are numbered in input order by counting the bits of a set below them; facets are put in
// order by counting, since each vertex is the lowest of a few only.
#include "hull/detail/number_hull.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hull/detail/finish_hull.hpp"
#include "hull/detail/whole_faces.hpp"

namespace carpus::hull {
namespace {

/// Above this many facets of one lowest vertex they are sorted, not inserted one by one.
constexpr std::uint32_t kMostInserted = 24;

/// So many facets ahead memory is asked for.
constexpr std::size_t kAhead = 16;

/// A set of input indices that knows how many members are below one.
class IndexSet {
 public:
  explicit IndexSet(std::size_t size) : words_(size / 64 + 1), below_(size / 64 + 1) {}
  void insert(std::uint32_t i) { words_[i / 64] |= std::uint64_t{1} << (i % 64); }
  /// To be called once, after the last insertion.
  std::uint32_t count() {
    std::uint32_t sum = 0;
    for (std::size_t w = 0; w < words_.size(); ++w) {
      below_[w] = sum;
      sum += static_cast<std::uint32_t>(std::popcount(words_[w]));
    }
    return sum;
  }
  [[nodiscard]] std::uint32_t rank(std::uint32_t i) const {
    const std::uint64_t lower = words_[i / 64] & ((std::uint64_t{1} << (i % 64)) - 1);
    return below_[i / 64] + static_cast<std::uint32_t>(std::popcount(lower));
  }

 private:
  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> below_;
};

/// Numbers the vertices that facets have. @return the number of each grown vertex, or kNone.
std::vector<std::uint32_t> number_vertices(std::span<const Vec3> points,
                                           const GrownHull& hull,
                                           const std::vector<FinalFacet>& facets,
                                           ConvexPolytope& polytope) {
  std::vector<std::uint32_t> number(hull.vertices.size(), kNone);
  for (const FinalFacet& facet : facets) {
    for (const std::uint32_t v : facet.corners) number[v] = 0;
  }
  IndexSet used(points.size());
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] != kNone) used.insert(hull.input_indices[v]);
  }
  const std::uint32_t count = used.count();
  polytope.vertices.resize(count);
  polytope.input_indices.resize(count);
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    number[v] = used.rank(hull.input_indices[v]);
    polytope.vertices[number[v]] = hull.vertices[v];
    polytope.input_indices[number[v]] = hull.input_indices[v];
  }
  return number;
}

/// Numbers each facet's corners, and turns it to begin with the lowest number.
void number_corners(const std::vector<std::uint32_t>& number, std::vector<FinalFacet>& facets) {
  for (FinalFacet& facet : facets) {
    const auto [x, y, z] = facet.neighbours;
    const std::uint32_t a = number[facet.corners[0]];
    const std::uint32_t b = number[facet.corners[1]];
    const std::uint32_t c = number[facet.corners[2]];
    if (b < a && b < c) {
      facet = {{b, c, a}, {y, z, x}};
    } else if (c < a && c < b) {
      facet = {{c, a, b}, {z, x, y}};
    } else {
      facet.corners = {a, b, c};
    }
  }
}

struct Entry {
  std::uint32_t second;  ///< corner, by which the facets of one lowest corner are put in order
  std::uint32_t facet;
};

/// The facets in the order of their numbered corners.
std::vector<Entry> ordered(const std::vector<FinalFacet>& facets, std::size_t vertex_count) {
  std::vector<std::uint32_t> end(vertex_count + 1, 0);
  for (const FinalFacet& facet : facets) ++end[facet.corners[0] + 1];
  for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];
  std::vector<Entry> entries(facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    entries[end[facets[f].corners[0]]++] = {facets[f].corners[1], f};
  }
  // Now end[v] is where the facets of v end; those of v - 1 end where they begin.
  const auto is_before = [](const Entry& a, const Entry& b) { return a.second < b.second; };
  std::uint32_t begin = 0;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const bool are_few = end[v] - begin <= kMostInserted;
    if (!are_few) std::sort(entries.begin() + begin, entries.begin() + end[v], is_before);
    for (std::uint32_t i = begin + 1; are_few && i < end[v]; ++i) {
      const Entry moving = entries[i];
      std::uint32_t at = i;
      for (; at > begin && moving.second < entries[at - 1].second; --at)
        entries[at] = entries[at - 1];
      entries[at] = moving;
    }
    begin = end[v];
  }
  return entries;
}

}  // namespace

ConvexPolytope number_hull(std::span<const Vec3> points,
                           const GrownHull& hull,
                           HullStatistics& statistics) {
  ConvexPolytope polytope;
  std::vector<FinalFacet> facets = whole_faces(hull, statistics);
  const std::vector<std::uint32_t> number = number_vertices(points, hull, facets, polytope);
  number_corners(number, facets);
  const std::vector<Entry> entries = ordered(facets, polytope.vertices.size());
  std::vector<std::uint32_t> places(facets.size());
  for (std::uint32_t i = 0; i < entries.size(); ++i) places[entries[i].facet] = i;
  polytope.facets.reserve(facets.size());
  polytope.neighbours.reserve(facets.size());
  polytope.planes.reserve(facets.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    // What is read is scattered; what comes soon is asked for.
    __builtin_prefetch(&facets[entries[std::min(i + kAhead, entries.size() - 1)].facet]);
    const auto& [corners, neighbours] = facets[entries[i].facet];
    const auto& [a, b, c] = corners;
    polytope.facets.push_back(corners);
    polytope.neighbours.push_back(
        {places[neighbours[0]], places[neighbours[1]], places[neighbours[2]]});
    polytope.planes.push_back(
        facet_plane(polytope.vertices[a], polytope.vertices[b], polytope.vertices[c], true));
  }
  return polytope;
}

}  // namespace carpus::hull

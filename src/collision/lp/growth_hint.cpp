// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The features that the growth program's last rows share, for exact arithmetic to begin with.
#include <algorithm>
#include <array>
#include <cstdint>

#include "collision/lp/growth_program.hpp"

namespace carpus::collision {
namespace {

/// A vertex of a body lies on all its faces among some rows.
bool is_on_all(const ConvexBody& body,
               const PolarGraph& graph,
               const std::array<GrowthRow, 4>& rows,
               bool is_second,
               std::uint32_t vertex) noexcept {
  return std::all_of(rows.begin(), rows.end(), [&](const GrowthRow& row) {
    if (row.is_second != is_second || row.face == GrowthRow::kNoFace) return true;
    const auto& corners = body.faces()[graph.face_of_body(row.face)].corners;
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
  });
}

/// Up to three vertices of a body that all its faces among some rows share: a vertex, an edge, or
/// corners of a face.
struct Feature {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t count = 0;
};

Feature feature_of(const ConvexBody& body,
                   const PolarGraph& graph,
                   const std::array<GrowthRow, 4>& rows,
                   bool is_second) noexcept {
  Feature shared;
  const auto own = std::find_if(rows.begin(), rows.end(), [&](const GrowthRow& row) {
    return row.is_second == is_second && row.face != GrowthRow::kNoFace;
  });
  if (own == rows.end()) return shared;
  for (const std::uint32_t c : body.faces()[graph.face_of_body(own->face)].corners) {
    if (shared.count == shared.vertices.size()) break;
    if (is_on_all(body, graph, rows, is_second, c)) shared.vertices[shared.count++] = c;
  }
  return shared;
}

}  // namespace

ExactHint GrowthProgram::hint(const ConvexBody& first,
                              const ConvexBody& second,
                              const GrowthMemory& memory) const noexcept {
  ExactHint hint;
  hint.direction = memory.separation.n;
  const Feature a = feature_of(first, this->first(), memory.rows, false);
  const Feature b = feature_of(second, this->second(), memory.rows, true);
  if (a.count == 0 || b.count == 0) return hint;
  hint.first_vertex = a.vertices[0];
  hint.second_vertex = b.vertices[0];
  const std::uint32_t pairs = a.count * b.count;
  if (pairs > hint.seeds.size()) return hint;
  for (std::uint32_t i = 0; i < a.count; ++i) {
    for (std::uint32_t j = 0; j < b.count; ++j) {
      hint.seeds[hint.seed_count++] = {a.vertices[i], b.vertices[j]};
    }
  }
  return hint;
}

}  // namespace carpus::collision

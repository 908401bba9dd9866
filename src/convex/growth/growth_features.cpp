// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/growth_features.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "geometry/vec3.hpp"

namespace carpus::convex {
namespace {

GrowthRow row_of(const PolarGraph& graph, std::uint32_t face, bool is_second) noexcept {
  return {graph.row(face).normal(), face, is_second};
}

void set_edge_rows(const ProofBody& body,
                   const Feature& edge,
                   bool is_second,
                   std::span<GrowthRow, 2> rows) noexcept {
  const PolarGraph& graph = *body.facets;
  rows[0] = row_of(graph, graph.face_from_body(edge.left), is_second);
  rows[1] = row_of(graph, graph.face_from_body(edge.right), is_second);
}

/// @param down  opposite to the face's normal, in the vertex's body.
void set_vertex_rows(const PolarGraph& graph,
                     std::uint32_t vertex,
                     const Vec3& down,
                     bool is_second,
                     std::span<GrowthRow, 3> rows) noexcept {
  const std::span<const std::uint32_t> fan = graph.faces_about(vertex);
  const Vec3 across = cross(down, graph.row(fan[0]).normal());
  std::size_t i = 2;
  while (i + 1 < fan.size() && dot(across, graph.row(fan[i]).normal()) > 0) ++i;
  rows[0] = row_of(graph, fan[0], is_second);
  rows[1] = row_of(graph, fan[i - 1], is_second);
  rows[2] = row_of(graph, fan[i], is_second);
}

/// A vertex on all of the faces; `otherwise` if there is none.
std::uint32_t common_vertex(const VoronoiFeatures& body,
                            std::span<const std::uint32_t> faces,
                            std::uint32_t otherwise) noexcept {
  const auto has = [&](std::uint32_t face, std::uint32_t vertex) {
    const auto sides = body.sides(face);
    return std::any_of(sides.begin(), sides.end(),
                       [&](const VoronoiFeatures::Side& side) { return side.corner == vertex; });
  };
  for (const VoronoiFeatures::Side& side : body.sides(faces[0])) {
    if (std::all_of(faces.begin() + 1, faces.end(),
                    [&](std::uint32_t face) { return has(face, side.corner); })) {
      return side.corner;
    }
  }
  return otherwise;
}

/// @param along  towards the other body, in the body's frame.
Feature feature_of(const ProofBody& body,
                   std::span<const GrowthRow> rows,
                   const Vec3& along) noexcept {
  std::array<std::uint32_t, 3> faces{};
  for (std::size_t i = 0; i < rows.size(); ++i) faces[i] = body.facets->face_of_body(rows[i].face);
  if (rows.size() == 1) return Feature::face(faces[0]);
  const auto sides = body.features->sides(faces[0]);
  if (rows.size() == 2) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (sides[i].neighbour == faces[1]) return body.features->side_edge(faces[0], i);
    }
  }
  const std::uint32_t near = body.corners->climb(along, sides.front().corner);
  return Feature::vertex(common_vertex(*body.features, std::span(faces).first(rows.size()), near));
}

/// Up to three vertices of a feature.
struct Corners {
  std::array<std::uint32_t, 3> at{};
  std::size_t count = 0;
};

Corners corners_of(const VoronoiFeatures& body, const Feature& feature) noexcept {
  if (feature.kind == FeatureKind::Vertex) return {{feature.id}, 1};
  if (feature.kind == FeatureKind::Edge) return {{feature.id, feature.head}, 2};
  const auto sides = body.sides(feature.id);
  return {{sides[0].corner, sides[1].corner, sides[2].corner}, 3};
}

}  // namespace

bool set_rows(const ProofBody& first,
              const ProofBody& second,
              const RelativePose& pose,
              const FeaturePair& pair,
              GrowthMemory& memory) noexcept {
  const std::span<GrowthRow, 4> rows(memory.rows);
  if (pair.first.kind == FeatureKind::Edge && pair.second.kind == FeatureKind::Edge) {
    set_edge_rows(first, pair.first, false, rows.first<2>());
    set_edge_rows(second, pair.second, true, rows.last<2>());
    memory.first_rows = 2;
    return true;
  }
  if (pair.first.kind == FeatureKind::Face && pair.second.kind == FeatureKind::Vertex) {
    rows[0] = row_of(*first.facets, first.facets->face_from_body(pair.first.id), false);
    set_vertex_rows(*second.facets, pair.second.id, -pose.into_second(rows[0].normal), true,
                    rows.last<3>());
    memory.first_rows = 1;
    return true;
  }
  if (pair.first.kind == FeatureKind::Vertex && pair.second.kind == FeatureKind::Face) {
    rows[3] = row_of(*second.facets, second.facets->face_from_body(pair.second.id), true);
    set_vertex_rows(*first.facets, pair.first.id, -(pose.rotation * rows[3].normal), false,
                    rows.first<3>());
    memory.first_rows = 3;
    return true;
  }
  return false;
}

bool features_of_rows(const ProofBody& first,
                      const ProofBody& second,
                      const GrowthMemory& memory,
                      FeaturePair& pair) noexcept {
  const std::span<const GrowthRow> rows(memory.rows);
  const auto count = static_cast<std::size_t>(memory.first_rows);
  if (count < 1 || count > 3 || std::any_of(rows.begin(), rows.end(), [](const GrowthRow& row) {
        return row.face == GrowthRow::kNoFace;
      })) {
    return false;
  }
  pair.first = feature_of(first, rows.first(count), memory.separation.n);
  pair.second = feature_of(second, rows.subspan(count), memory.separation.m);
  return true;
}

std::uint32_t face_at(const ProofBody& body, const Feature& feature) noexcept {
  if (feature.kind == FeatureKind::Vertex) return body.facets->faces_about(feature.id)[0];
  return body.facets->face_from_body(feature.kind == FeatureKind::Face ? feature.id : feature.left);
}

ExactHint hint_of(const ProofBody& first,
                  const ProofBody& second,
                  const FeaturePair& pair,
                  const Vec3& direction) noexcept {
  ExactHint hint;
  hint.direction = direction;
  const Corners a = corners_of(*first.features, pair.first);
  const Corners b = corners_of(*second.features, pair.second);
  hint.first_vertex = a.at[0];
  hint.second_vertex = b.at[0];
  if (a.count * b.count > hint.seeds.size()) return hint;
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t k = 0; k < b.count; ++k) {
      hint.seeds[hint.seed_count++] = {a.at[i], b.at[k]};
    }
  }
  return hint;
}

}  // namespace carpus::convex

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/body_levels.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "convex/features/placement.hpp"
#include "convex/features/regions.hpp"
#include "convex/features/segments.hpp"
#include "hull/quickhull.hpp"

namespace carpus::survey {
namespace {

/// Below this there is nothing to gain: a walk over a dozen vertices takes three or four steps.
constexpr std::size_t kFewestVertices = 12;
/// In a triangulation the mean degree is below six; higher degrees would leave deep dents.
constexpr std::size_t kHighestDegree = 8;
/// Added to deviations for the rounding of their computation [mm].
constexpr double kDeviationMarginMm = 1e-9;

/// How far a vertex stands out over its neighbours' mean: roughly what removing it costs.
double prominence(const convex::VoronoiFeatures& features, std::uint32_t v) {
  Vec3 sum;
  const auto spokes = features.spokes(v);
  for (const convex::VoronoiFeatures::Spoke& spoke : spokes) sum += features.vertex(spoke.end);
  return distance(features.vertex(v), sum / static_cast<double>(spokes.size()));
}

/// The vertices that stay when an independent set of low degree goes, ascending.
std::vector<std::uint32_t> without_independent_set(const convex::VoronoiFeatures& features) {
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t v = 0; v < features.vertex_count(); ++v) {
    if (features.spokes(v).size() <= kHighestDegree) order.emplace_back(prominence(features, v), v);
  }
  std::sort(order.begin(), order.end());
  enum class Mark : std::uint8_t { Free, Kept, Removed };
  std::vector<Mark> marks(features.vertex_count(), Mark::Free);
  std::size_t left = features.vertex_count();
  for (const auto& [unused, v] : order) {
    if (marks[v] != Mark::Free || left <= kFewestVertices) continue;
    marks[v] = Mark::Removed;
    --left;
    for (const convex::VoronoiFeatures::Spoke& spoke : features.spokes(v))
      marks[spoke.end] = Mark::Kept;
  }
  std::vector<std::uint32_t> staying;
  for (std::uint32_t v = 0; v < marks.size(); ++v) {
    if (marks[v] != Mark::Removed) staying.push_back(v);
  }
  return staying;
}

/// From one set of vertices to a hull of some of them.
struct Reduction {
  convex::ConvexBody body;
  std::vector<std::uint32_t> vertices;  ///< [v of the hull]: v of the set
};

/// Two rounds; empty where the rest bounds no volume.
std::vector<Reduction> reduce(const convex::VoronoiFeatures& features) {
  std::vector<Reduction> result;
  std::vector<std::uint32_t> numbers(features.vertex_count());
  std::iota(numbers.begin(), numbers.end(), 0U);
  const convex::VoronoiFeatures* from = &features;
  convex::VoronoiFeatures halfway = features;
  for (int round = 0; round < 2; ++round) {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t v : without_independent_set(*from)) {
      points.push_back(from->vertex(v));
      kept.push_back(numbers[v]);
    }
    hull::HullResult hull = hull::build_convex_hull(points);
    if (hull.status != hull::HullStatus::Ok) break;
    numbers.clear();
    for (const std::uint32_t i : hull.polytope.input_indices) numbers.push_back(kept[i]);
    result.clear();
    result.push_back({convex::ConvexBody(std::move(hull.polytope)), numbers});
    halfway = convex::VoronoiFeatures(result.front().body, {});
    from = &halfway;
  }
  return result;
}

double distance_outside(const convex::VoronoiFeatures& hull, const Vec3& p) {
  const convex::FixedBody body{&hull};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t f = 0; f < hull.face_count(); ++f) {
    const double height = hull.plane(f).signed_distance(p);
    if (height <= 0) continue;
    if (!convex::leave_face(body, f, p)) {
      nearest = std::min(nearest, height);
      continue;
    }
    for (std::size_t i = 0; i < hull.sides(f).size(); ++i) {
      const convex::Feature side = hull.side_edge(f, i);
      const convex::Segment segment{hull.vertex(side.id),
                                    hull.vertex(side.head) - hull.vertex(side.id)};
      nearest = std::min(nearest, distance(p, segment.at(convex::nearest_on(segment, p))));
    }
  }
  return std::isfinite(nearest) ? nearest : 0;  // below all planes
}

double deviation_of(const convex::VoronoiFeatures& hull, std::span<const Vec3> vertices) {
  double worst = 0;
  for (const Vec3& v : vertices) worst = std::max(worst, distance_outside(hull, v));
  return worst + kDeviationMarginMm;
}

/// [v]: its number in the reduced set, or that of the nearest vertex there.
std::vector<std::uint32_t> links_to_coarser(const convex::VoronoiFeatures& fine,
                                            const convex::VoronoiFeatures& coarse) {
  std::vector<std::uint32_t> links;
  for (const Vec3& v : fine.vertices()) {
    const auto nearer = [&](const Vec3& a, const Vec3& b) {
      return squared_length(a - v) < squared_length(b - v);
    };
    const auto all = coarse.vertices();
    links.push_back(
        static_cast<std::uint32_t>(std::min_element(all.begin(), all.end(), nearer) - all.begin()));
  }
  return links;
}

}  // namespace

BodyLevels::BodyLevels(const convex::ConvexBody& body) {
  levels_.push_back({convex::VoronoiFeatures(body), 0, {}, {}});
  while (levels_.back().features.vertex_count() > kFewestVertices) {
    std::vector<Reduction> reduced = reduce(levels_.back().features);
    if (reduced.empty() ||
        reduced.front().vertices.size() >= levels_.back().features.vertex_count()) {
      break;
    }
    Level next{convex::VoronoiFeatures(reduced.front().body, {}),
               0,
               std::move(reduced.front().vertices),
               {}};
    next.deviation_mm = deviation_of(next.features, levels_.front().features.vertices());
    levels_.back().coarser = links_to_coarser(levels_.back().features, next.features);
    levels_.push_back(std::move(next));
  }
}

}  // namespace carpus::survey

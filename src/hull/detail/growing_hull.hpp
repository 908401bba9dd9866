// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The growing of fast_hull: from a tetrahedron to the hull, the farthest point of a facet at a
// time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/vec3.hpp"
#include "hull/detail/conflict_points.hpp"
#include "hull/detail/facet_queue.hpp"
#include "hull/detail/hull_facet.hpp"
#include "hull/detail/input_check.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

class GrowingHull {
 public:
  /// @param start  four points of `points` that span a tetrahedron.
  GrowingHull(std::span<const Vec3> points, const StartSimplex& start, HullStatistics& statistics);

  /// Makes the hull contain the points of these indices.
  void add(std::span<const std::uint32_t> indices);

  /// Makes the hull contain all points. Those within the hull as it is are passed over quickly.
  void add_all();

  [[nodiscard]] GrownHull take() { return std::move(hull_); }

 private:
  /// What the batch is tested against: a fresh facet's plane, and where its points go.
  struct Target {
    std::uint32_t facet;
    std::uint32_t count;
  };

  [[nodiscard]] const Vec3& corner(const GrowingFacet& facet, std::size_t i) const {
    return hull_.vertices[facet.corners[i]];
  }
  [[nodiscard]] Conflict conflict_at(std::uint32_t i) const {
    return {points_[i].x, points_[i].y, points_[i].z, i, 0};
  }
  std::uint32_t add_vertex(const Vec3& p, std::uint32_t input_index);
  std::uint32_t make_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void start_from(const std::array<std::uint32_t, 4>& corners);
  void target_every_facet();

  void find_slots();
  [[nodiscard]] std::uint32_t exact_slot(const Vec3& p);
  void classify_batch(std::size_t begin);
  void reserve_ranges();
  void place(const Conflict& conflict, std::uint32_t slot);
  void place_batch();
  void close_gaps();
  [[nodiscard]] bool is_waiting(const FacetQueue::Entry& entry) const {
    const GrowingFacet& facet = hull_.facets[entry.facet];
    return facet.conflicts != 0 && facet.first_conflict == entry.first_conflict;
  }
  [[nodiscard]] Vec3 place_of(const GrowingFacet& facet) const {
    return (corner(facet, 0) + corner(facet, 1) + corner(facet, 2)) / 3;
  }
  bool keep(FacetQueue::Entry& entry, const Conflict* from);

  void grow();
  [[nodiscard]] bool is_to_be_divided() const;
  void divide();
  bool next_cell();
  [[nodiscard]] std::size_t farthest_conflict(const GrowingFacet& facet) const;
  [[nodiscard]] bool sees(const GrowingFacet& facet, const Vec3& p);
  void find_horizon(std::uint32_t start, const Vec3& p);
  void remove(std::uint32_t facet);
  void add_point(std::uint32_t start);
  void join_horizon(std::uint32_t apex);
  void redistribute(std::size_t apex);
  void redistribute_many(std::size_t apex);

  std::span<const Vec3> points_;
  Vec3 low_;
  Vec3 extent_;
  HullStatistics& statistics_;
  GrownHull hull_;
  std::vector<std::uint32_t> free_;  ///< removed facets
  std::uint32_t round_ = 0;

  FacetQueue queue_;  ///< facets with conflicts
  std::size_t arena_capacity_;
  ConflictArray arena_;
  std::size_t arena_end_ = 0;
  std::size_t cell_begin_ = 0;  ///< of the arena's part that the cell at work has written
  std::size_t waiting_ = 0;     ///< conflicts of all facets

  PointBlock block_;

  ConflictArray batch_;
  std::size_t batch_count_ = 0;
  std::vector<Target> targets_;

  std::vector<std::uint32_t> walk_;
  std::vector<std::uint32_t> seen_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> horizon_;  ///< inner and outer side
};

}  // namespace carpus::hull

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Every edge of the grown hull is tested: certainly convex, or exactly coplanar.
// 2. Facets that meet in coplanar edges get the same face.
// 3. The border of such a face is walked. Its half-edges fall into runs of one neighbouring face
//    each; where the run changes is a corner, since three faces meet there, and within a run the
//    half-edges lie on one line. Each run is one edge of the face, and the fan replaces the facets.
// 4. Neighbours, until now sides of the grown hull, become numbers of final facets.
#include "hull/detail/whole_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "core/check.hpp"

namespace carpus::hull {
namespace {

/// In `neighbours` until step 4: this bit and a final number, or a side of the grown hull.
constexpr std::uint32_t kIsFinal = 1U << 31U;

class FaceMerger {
 public:
  FaceMerger(const GrownHull& hull, HullStatistics& statistics)
      : facets_(hull.facets), hull_(hull), statistics_(statistics), number_(facets_.size()) {
    CARPUS_CHECK(facets_.size() < kIsFinal / 4);
    final_.reserve(2 * hull.vertices.size());
    take_facets_alone();
    if (!coplanar_.empty()) {
      join_faces();
      take_faces();
    }
    for (FinalFacet& facet : final_) {
      for (std::uint32_t& s : facet.neighbours) s = resolved(s);
    }
  }
  [[nodiscard]] std::vector<FinalFacet> take() { return std::move(final_); }

 private:
  /// The facets as if no two were coplanar; notes those that are.
  void take_facets_alone() {
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      const GrowingFacet& facet = facets_[f];
      if (facet.round == kNone) continue;
      number_[f] = static_cast<std::uint32_t>(final_.size());
      final_.push_back({facet.corners, facet.across});
      for (std::uint32_t e = 0; e < 3; ++e) {
        const std::uint32_t outer = facet.across[e];
        if (facet_of(outer) > f && !is_convex(facet, outer)) coplanar_.push_back(outer);
      }
    }
  }

  void take_faces() {
    final_.clear();
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      if (facets_[f].round == kNone) continue;
      if (!is_joined_[f]) {
        number_[f] = static_cast<std::uint32_t>(final_.size());
        final_.push_back({facets_[f].corners, facets_[f].across});
      } else if (!is_done_[face_[f]]) {
        add_face_of(f);
      }
    }
  }

  [[nodiscard]] bool is_convex(const GrowingFacet& facet, std::uint32_t outer) {
    ++statistics_.orientation_tests;
    const Triangle& other = facets_[facet_of(outer)].corners;
    const Vec3& opposite = hull_.vertices[other[kNextEdge[kNextEdge[edge_of(outer)]]]];
    const double height = facet.plane.height(opposite);
    if (height < -facet.plane.bound) return true;
    if (facet.plane.bound == 0) return false;
    ++statistics_.exact_fallbacks;
    const Triangle& t = facet.corners;
    return orient3d_exact(hull_.vertices[t[0]], hull_.vertices[t[1]], hull_.vertices[t[2]],
                          opposite) != 0;
  }

  /// The representative of a facet's face, paths halved on the way.
  std::uint32_t face_of(std::uint32_t f) {
    while (face_[f] != f) f = face_[f] = face_[face_[f]];
    return f;
  }

  void join_faces() {
    face_.resize(facets_.size());
    std::iota(face_.begin(), face_.end(), 0U);
    is_joined_.assign(facets_.size(), false);
    is_done_.assign(facets_.size(), false);
    new_facet_.resize(4 * facets_.size());
    for (const std::uint32_t outer : coplanar_) {
      const std::uint32_t f = facet_of(outer);
      const std::uint32_t g = facet_of(facets_[f].across[edge_of(outer)]);
      is_joined_[f] = is_joined_[g] = true;
      const std::uint32_t a = face_of(f);
      const std::uint32_t b = face_of(g);
      face_[std::max(a, b)] = std::min(a, b);
    }
    for (std::uint32_t f = 0; f < face_.size(); ++f) face_[f] = face_[face_[f]];  // low ones first
  }

  [[nodiscard]] bool is_alone(std::uint32_t f) const { return coplanar_.empty() || !is_joined_[f]; }
  [[nodiscard]] std::uint32_t outer_of(std::uint32_t inner) const {
    return facets_[facet_of(inner)].across[edge_of(inner)];
  }
  [[nodiscard]] std::uint32_t face_across(std::uint32_t inner) const {
    return face_[facet_of(outer_of(inner))];
  }

  /// The next half-edge along the border of the face: turning about the end of this one.
  [[nodiscard]] std::uint32_t next_on_border(std::uint32_t inner) const {
    const std::uint32_t face = face_[facet_of(inner)];
    std::uint32_t next = side(facet_of(inner), kNextEdge[edge_of(inner)]);
    while (face_across(next) == face) {
      const std::uint32_t outer = outer_of(next);
      next = side(facet_of(outer), kNextEdge[edge_of(outer)]);
    }
    return next;
  }

  /// First and last half-edge of each run along the face's border.
  void find_runs(std::uint32_t on_border) {
    std::uint32_t start = on_border;  // moved to the first of its run
    do {
      const std::uint32_t next = next_on_border(start);
      const bool changes = face_across(next) != face_across(start);
      start = next;
      if (changes) break;
    } while (start != on_border);
    runs_.clear();
    std::uint32_t at = start;
    do {
      if (runs_.empty() || face_across(at) != face_across(runs_.back().second)) {
        runs_.push_back({at, at});
      }
      runs_.back().second = at;
      at = next_on_border(at);
    } while (at != start);
    CARPUS_CHECK(runs_.size() >= 3);
  }

  /// Where facet f has an edge on the border of its face: the face, as a fan.
  void add_face_of(std::uint32_t f) {
    for (std::uint32_t e = 0; e < 3; ++e) {
      if (face_across(side(f, e)) == face_[f]) continue;
      is_done_[face_[f]] = true;
      find_runs(side(f, e));
      add_fan_of_runs();
      return;
    }
  }

  [[nodiscard]] std::uint32_t start_of(const std::pair<std::uint32_t, std::uint32_t>& run) const {
    return facets_[facet_of(run.first)].corners[edge_of(run.first)];
  }

  void add_fan_of_runs() {
    const auto lowest = std::min_element(runs_.begin(), runs_.end(), [&](auto& a, auto& b) {
      return hull_.input_indices[start_of(a)] < hull_.input_indices[start_of(b)];
    });
    std::rotate(runs_.begin(), lowest, runs_.end());
    const auto base = static_cast<std::uint32_t>(final_.size());
    const auto triangles = static_cast<std::uint32_t>(runs_.size() - 2);
    for (std::uint32_t i = 0; i < triangles; ++i) {
      const bool is_last = i + 1 == triangles;
      FinalFacet facet{
          {start_of(runs_[0]), start_of(runs_[i + 1]), start_of(runs_[i + 2])},
          {kIsFinal | (base + i - 1), outer_of(runs_[i + 1].second), kIsFinal | (base + i + 1)}};
      new_facet_[runs_[i + 1].first] = base + i;
      if (i == 0) {
        facet.neighbours[0] = outer_of(runs_[0].second);
        new_facet_[runs_[0].first] = base;
      }
      if (is_last) {
        facet.neighbours[2] = outer_of(runs_.back().second);
        new_facet_[runs_.back().first] = base + i;
      }
      final_.push_back(facet);
    }
  }

  [[nodiscard]] std::uint32_t resolved(std::uint32_t s) const {
    if ((s & kIsFinal) != 0) return s & ~kIsFinal;
    return is_alone(facet_of(s)) ? number_[facet_of(s)] : new_facet_[s];
  }

  const std::vector<GrowingFacet>& facets_;
  const GrownHull& hull_;
  HullStatistics& statistics_;
  std::vector<std::uint32_t> number_;     ///< of a facet that is alone: in final_
  std::vector<std::uint32_t> coplanar_;   ///< one side of each coplanar edge
  std::vector<std::uint32_t> face_;       ///< the lowest facet of the face; unused without faces
  std::vector<bool> is_joined_;           ///< by facet: part of a face of several
  std::vector<bool> is_done_;             ///< by face
  std::vector<std::uint32_t> new_facet_;  ///< by the first side of a run
  std::vector<std::pair<std::uint32_t, std::uint32_t>> runs_;
  std::vector<FinalFacet> final_;
};

}  // namespace

std::vector<FinalFacet> whole_faces(const GrownHull& hull, HullStatistics& statistics) {
  return FaceMerger(hull, statistics).take();
}

}  // namespace carpus::hull

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/simplex.hpp"

#include "convex/double_double.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::survey {
namespace {

/// A tetrahedron whose sixth of a box is thinner than this, relative to its edges, is flat: nothing
/// is inside.
constexpr double kFlatTetrahedron = 64 * kRoundoff;

template <typename V>
class Search {
 public:
  using T = ScalarOf<V>;

  explicit Search(const std::array<V, 4>& w) noexcept : w_(w) {}

  [[nodiscard]] const SimplexNearest<V>& best() const noexcept { return best_; }

  void try_corner(std::size_t i) noexcept {
    if (!is_better(dot(w_[i], w_[i]))) return;
    best_.point = w_[i];
    set_weights({{i, T(1)}});
  }

  void try_edge(std::size_t i, std::size_t j) noexcept {
    const V e = w_[j] - w_[i];
    const T along = -dot(w_[i], e);
    const T squared = dot(e, e);
    if (!(along > T(0))) return try_corner(i);
    if (!(along < squared)) return try_corner(j);
    const T t = along / squared;
    const V p = w_[i] + e * t;
    if (!is_better(dot(p, p))) return;
    best_.point = p;
    set_weights({{i, T(1) - t}, {j, t}});
  }

  void try_face(std::size_t i, std::size_t j, std::size_t k) noexcept {
    const V e = w_[j] - w_[i];
    const V f = w_[k] - w_[i];
    const V n = cross(e, f);
    const T squared = dot(n, n);
    if (!(squared > T(0))) {
      try_edge(i, j);
      try_edge(j, k);
      return try_edge(k, i);
    }
    const V to_origin = -w_[i];
    const T area_j = dot(cross(to_origin, f), n);
    const T area_k = dot(cross(e, to_origin), n);
    const T area_i = squared - area_j - area_k;
    const bool beyond_i = !(area_i > T(0));
    const bool beyond_j = !(area_j > T(0));
    const bool beyond_k = !(area_k > T(0));
    if (!beyond_i && !beyond_j && !beyond_k) {
      const V p = n * (dot(n, w_[i]) / squared);
      if (!is_better(dot(p, p))) return;
      best_.point = p;
      set_weights({{i, area_i / squared}, {j, area_j / squared}, {k, area_k / squared}});
      return;
    }
    if (beyond_i) try_edge(j, k);
    if (beyond_j) try_edge(k, i);
    if (beyond_k) try_edge(i, j);
  }

  void try_tetrahedron() noexcept {
    constexpr std::array<std::array<std::size_t, 4>, 4> kFaces{
        {{1, 2, 3, 0}, {0, 2, 3, 1}, {0, 1, 3, 2}, {0, 1, 2, 3}}};
    std::array<T, 4> weights;
    bool is_inside = true;
    for (const auto& [i, j, k, opposite] : kFaces) {
      const V e = w_[j] - w_[i];
      const V f = w_[k] - w_[i];
      const V g = w_[opposite] - w_[i];
      const V n = cross(e, f);
      const T volume = dot(n, g);
      const T origin = -dot(n, w_[i]);
      const T limit = T(kFlatTetrahedron * kFlatTetrahedron) * dot(n, n) * dot(g, g);
      const bool is_flat = !(volume * volume > limit);
      if (is_flat || (volume > T(0)) != (origin > T(0))) {
        is_inside = false;
        try_face(i, j, k);
      } else {
        weights[opposite] = origin / volume;
      }
    }
    if (!is_inside) return;
    best_.point = V{};
    best_.weights = weights;
    best_.used = 0xF;
    best_.contains_origin = true;
  }

 private:
  struct Weight {
    std::size_t corner;
    T value;
  };

  /// Notes `squared_distance` if it is the least.
  bool is_better(const T& squared_distance) noexcept {
    if (best_.used != 0 && !(squared_distance < least_)) return false;
    least_ = squared_distance;
    return true;
  }

  template <std::size_t N>
  void set_weights(const Weight (&weights)[N]) noexcept {  // NOLINT(*-avoid-c-arrays)
    best_.weights = {};
    best_.used = 0;
    for (const Weight& weight : weights) {
      best_.weights[weight.corner] = weight.value;
      best_.used = static_cast<std::uint8_t>(best_.used | (1U << weight.corner));
    }
  }

  const std::array<V, 4>& w_;
  SimplexNearest<V> best_;
  T least_{};
};

}  // namespace

template <typename V>
SimplexNearest<V> nearest_of_simplex(const std::array<V, 4>& w, std::size_t count) noexcept {
  Search<V> search(w);
  switch (count) {
    case 1:
      search.try_corner(0);
      break;
    case 2:
      search.try_edge(0, 1);
      break;
    case 3:
      search.try_face(0, 1, 2);
      break;
    default:
      search.try_tetrahedron();
      break;
  }
  return search.best();
}

template SimplexNearest<Vec3> nearest_of_simplex(const std::array<Vec3, 4>&, std::size_t) noexcept;
template SimplexNearest<convex::WideVec3> nearest_of_simplex(const std::array<convex::WideVec3, 4>&,
                                                             std::size_t) noexcept;

}  // namespace carpus::survey

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Of each vertex and state the quadric of its facets' planes, weighed by their areas.
// 2. The cheapest collapse of each edge, either way, in a heap; what has changed since is stale.
// 3. The cheapest that keeps the manifold and turns no facet over is done; its neighbourhood is
//    weighed anew.
#include "mesh/simplify_in_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <queue>
#include <tuple>

#include "core/error.hpp"

namespace carpus::mesh {
namespace {

/// Cosine: no facet turns by more.
constexpr double kLeastCosine = 0.3;
/// Facets smaller than this have no normal worth keeping [mm2].
constexpr double kLeastAreaMm2 = 1e-6;

/// Sum of squared distances from planes, by weight, about an origin near the surface.
struct Quadric {
  std::array<double, 10> sums{};  // xx xy xz yy yz zz, xd yd zd, dd
  double weight = 0.0;

  void add_plane(const Vec3& n, double d, double w) {
    const std::array<double, 10> terms{n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z,
                                       n.z * n.z, n.x * d,   n.y * d,   n.z * d,   d * d};
    for (std::size_t i = 0; i < terms.size(); ++i) sums[i] += w * terms[i];
    weight += w;
  }

  void add(const Quadric& other) {
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += other.sums[i];
    weight += other.weight;
  }

  [[nodiscard]] double sum_at(const Vec3& p) const {
    const auto& s = sums;
    return p.x * (s[0] * p.x + 2 * (s[1] * p.y + s[2] * p.z + s[6])) +
           p.y * (s[3] * p.y + 2 * (s[4] * p.z + s[7])) + p.z * (s[5] * p.z + 2 * s[8]) + s[9];
  }
};

struct Collapse {
  double error = 0.0;  ///< squared [mm2]
  std::uint32_t from = 0;
  std::uint32_t onto = 0;
  std::uint32_t version = 0;  ///< of both ends, added

  bool operator>(const Collapse& other) const {
    return std::tie(error, from, onto) > std::tie(other.error, other.from, other.onto);
  }
};

class Collapsing {
 public:
  Collapsing(const std::vector<Triangle>& facets, std::span<const std::vector<Vec3>> states)
      : facets_(facets), states_(states), count_(states.front().size()), left_(facets.size()) {
    around_.resize(count_);
    versions_.resize(count_);
    quadrics_.resize(count_ * states_.size());
    origin_ = count_ > 0 ? states_.front().front() : Vec3{};
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      for (const std::uint32_t v : facets_[f]) around_[v].push_back(f);
      for (std::size_t s = 0; s < states_.size(); ++s) add_plane(f, s);
    }
    for (const Triangle& t : facets_) {
      for (std::size_t k = 0; k < 3; ++k) push(t[k], t[(k + 1) % 3]);
    }
  }

  void run(std::size_t target_facets) {
    while (left_ > target_facets && !heap_.empty()) {
      const Collapse next = heap_.top();
      heap_.pop();
      if (next.version != versions_[next.from] + versions_[next.onto]) continue;
      if (around_[next.from].empty() || around_[next.onto].empty()) continue;
      if (!is_allowed(next.from, next.onto)) continue;
      collapse(next.from, next.onto);
      greatest_ = std::max(greatest_, next.error);
    }
  }

  [[nodiscard]] InStates result() const {
    InStates result;
    result.error_mm = std::sqrt(std::max(0.0, greatest_));
    std::vector<std::uint32_t> number(count_);
    for (std::uint32_t v = 0; v < count_; ++v) {
      number[v] = static_cast<std::uint32_t>(result.kept.size());
      if (!around_[v].empty()) result.kept.push_back(v);
    }
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      const Triangle& t = facets_[f];
      if (is_there(f)) result.facets.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
    return result;
  }

 private:
  [[nodiscard]] bool is_there(std::uint32_t facet) const {
    const Triangle& t = facets_[facet];
    return t[0] != t[1];
  }

  [[nodiscard]] Vec3 across(const Triangle& t, std::size_t state) const {
    const auto& p = states_[state];
    return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
  }

  Quadric& quadric(std::uint32_t vertex, std::size_t state) {
    return quadrics_[vertex * states_.size() + state];
  }

  void add_plane(std::uint32_t facet, std::size_t state) {
    const Triangle& t = facets_[facet];
    const Vec3 twice = across(t, state);
    const double area = 0.5 * length(twice);
    if (!(area > kLeastAreaMm2)) return;
    const Vec3 normal = twice / (2 * area);
    const double d = -dot(normal, states_[state][t[0]] - origin_);
    for (const std::uint32_t v : t) quadric(v, state).add_plane(normal, d, area);
  }

  /// Greatest over the states.
  double error(std::uint32_t from, std::uint32_t onto) {
    double greatest = 0.0;
    for (std::size_t s = 0; s < states_.size(); ++s) {
      Quadric both = quadric(from, s);
      both.add(quadric(onto, s));
      if (!(both.weight > 0)) continue;
      greatest = std::max(greatest, both.sum_at(states_[s][onto] - origin_) / both.weight);
    }
    return greatest;
  }

  /// Either way, whichever is cheaper.
  void push(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t version = versions_[a] + versions_[b];
    const double onto_b = error(a, b);
    const double onto_a = error(b, a);
    heap_.push({onto_b, a, b, version});
    heap_.push({onto_a, b, a, version});
  }

  void neighbours(std::uint32_t vertex, std::vector<std::uint32_t>& found) const {
    found.clear();
    for (const std::uint32_t f : around_[vertex]) {
      for (const std::uint32_t v : facets_[f]) {
        if (v != vertex) found.push_back(v);
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }

  /// The link condition, and no facet turned over.
  [[nodiscard]] bool is_allowed(std::uint32_t from, std::uint32_t onto) {
    neighbours(from, near_from_);
    neighbours(onto, near_onto_);
    std::vector<std::uint32_t>& shared = shared_;
    shared.clear();
    std::set_intersection(near_from_.begin(), near_from_.end(), near_onto_.begin(),
                          near_onto_.end(), std::back_inserter(shared));
    // A fourth and last vertex would leave two facets back to back.
    if (shared.size() != 2 || near_from_.size() + near_onto_.size() < 8) return false;
    for (const std::uint32_t v : shared) {
      if (around_[v].size() <= 3) return false;
    }
    for (const std::uint32_t f : around_[from]) {
      Triangle moved = facets_[f];
      if (std::find(moved.begin(), moved.end(), onto) != moved.end()) continue;
      std::replace(moved.begin(), moved.end(), from, onto);
      for (std::size_t s = 0; s < states_.size(); ++s) {
        const Vec3 before = across(facets_[f], s);
        const Vec3 after = across(moved, s);
        const double lengths = length(before) * length(after);
        if (length(before) <= 2 * kLeastAreaMm2) continue;
        if (!(dot(before, after) > kLeastCosine * lengths)) return false;
      }
    }
    return true;
  }

  void collapse(std::uint32_t from, std::uint32_t onto) {
    for (std::size_t s = 0; s < states_.size(); ++s) quadric(onto, s).add(quadric(from, s));
    for (const std::uint32_t f : around_[from]) {
      Triangle& t = facets_[f];
      if (std::find(t.begin(), t.end(), onto) != t.end()) {
        for (const std::uint32_t v : t) {
          if (v != from) std::erase(around_[v], f);
        }
        t = {0, 0, 0};
        --left_;
        continue;
      }
      std::replace(t.begin(), t.end(), from, onto);
      around_[onto].push_back(f);
    }
    around_[from].clear();
    ++versions_[from];
    ++versions_[onto];
    neighbours(onto, near_onto_);
    for (const std::uint32_t v : near_onto_) push(onto, v);
  }

  std::vector<Triangle> facets_;
  std::span<const std::vector<Vec3>> states_;
  std::size_t count_ = 0;
  std::size_t left_ = 0;
  Vec3 origin_;
  std::vector<std::vector<std::uint32_t>> around_;  ///< facets of each vertex
  std::vector<std::uint32_t> versions_;
  std::vector<Quadric> quadrics_;
  std::priority_queue<Collapse, std::vector<Collapse>, std::greater<>> heap_;
  double greatest_ = 0.0;
  std::vector<std::uint32_t> near_from_;
  std::vector<std::uint32_t> near_onto_;
  std::vector<std::uint32_t> shared_;
};

}  // namespace

InStates simplify_in_states(const std::vector<Triangle>& facets,
                            std::span<const std::vector<Vec3>> states,
                            std::size_t target_facets) {
  if (states.empty()) throw InvalidInput("simplify_in_states: there is no state");
  for (const std::vector<Vec3>& places : states) {
    if (places.size() != states.front().size()) {
      throw InvalidInput("simplify_in_states: states differ in their numbers of vertices");
    }
  }
  Collapsing collapsing(facets, states);
  collapsing.run(target_facets);
  return collapsing.result();
}

}  // namespace carpus::mesh

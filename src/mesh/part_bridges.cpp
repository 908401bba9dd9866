// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/part_bridges.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "core/error.hpp"

namespace carpus::mesh {
namespace {

constexpr double kBetween = 0.5;
constexpr std::size_t kMostEdges = 600;
constexpr double kFromEnd =
    0.02;  ///< of an edge: a cut through a vertex would leave facets of no area

using Edge = std::pair<std::uint32_t, std::uint32_t>;  ///< the lower number first

Edge edge_of(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// Of a facet that the curve goes through: the vertex that is alone on its side, and the other two
/// in order.
struct Crossed {
  std::uint32_t facet = 0;
  std::array<std::uint32_t, 3> turned{};
};

struct Curve {
  std::vector<Crossed> facets;
  double length_mm = 0;
};

class Parting {
 public:
  Parting(std::span<const Vec3> vertices,
          const std::vector<Triangle>& facets,
          std::span<const float> level)
      : vertices_(vertices), facets_(facets), level_(level), curve_of_(facets.size(), kNone) {
    trace();
  }

  PartedBridges part(const std::function<bool(std::uint32_t)>& spans) {
    PartedBridges parted;
    std::vector<std::size_t> order(curves_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return curves_[a].length_mm > curves_[b].length_mm;
    });
    std::vector<bool> is_cut(curves_.size(), false);
    const std::size_t whole = pieces(is_cut);
    for (std::size_t i = 1; i < order.size(); ++i) {
      const Curve& curve = curves_[order[i]];
      if (curve.facets.size() > kMostEdges || goes_across(curve, spans)) continue;
      is_cut[order[i]] = true;
      if (pieces(is_cut) != whole) is_cut[order[i]] = false;
    }
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      if (curve_of_[f] == kNone || !is_cut[curve_of_[f]]) parted.facets.push_back(facets_[f]);
    }
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      if (!is_cut[c]) continue;
      cut(curves_[c], parted);
      ++parted.bridges;
    }
    return parted;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  [[nodiscard]] bool is_high(std::uint32_t v) const { return level_[v] >= kBetween; }

  [[nodiscard]] double share_of(std::uint32_t a, std::uint32_t b) const {
    const double from = level_[a];
    const double share = (kBetween - from) / (level_[b] - from);
    return std::clamp(share, kFromEnd, 1 - kFromEnd);
  }

  [[nodiscard]] Vec3 crossing(const Edge& edge) const {
    const auto [a, b] = edge;
    return vertices_[a] + (vertices_[b] - vertices_[a]) * share_of(a, b);
  }

  /// The curves of level 0.5, each by the facets that it goes through.
  void trace() {
    std::map<Edge, std::vector<std::uint32_t>> across;
    std::vector<Crossed> crossed;
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      const Triangle& t = facets_[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::array<std::uint32_t, 3> turned{t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
        if (is_high(turned[0]) == is_high(turned[1]) || is_high(turned[0]) == is_high(turned[2]))
          continue;
        const auto at = static_cast<std::uint32_t>(crossed.size());
        across[edge_of(turned[0], turned[1])].push_back(at);
        across[edge_of(turned[0], turned[2])].push_back(at);
        crossed.push_back({f, turned});
      }
    }
    for (std::uint32_t first = 0; first < crossed.size(); ++first) {
      if (curve_of_[crossed[first].facet] != kNone) continue;
      Curve curve;
      std::vector<std::uint32_t> open{first};
      while (!open.empty()) {
        const Crossed& one = crossed[open.back()];
        open.pop_back();
        if (curve_of_[one.facet] != kNone) continue;
        curve_of_[one.facet] = curves_.size();
        curve.facets.push_back(one);
        const Edge a = edge_of(one.turned[0], one.turned[1]);
        const Edge b = edge_of(one.turned[0], one.turned[2]);
        curve.length_mm += distance(crossing(a), crossing(b));
        for (const Edge& edge : {a, b}) {
          open.insert(open.end(), across[edge].begin(), across[edge].end());
        }
      }
      curves_.push_back(std::move(curve));
    }
  }

  [[nodiscard]] bool goes_across(const Curve& curve,
                                 const std::function<bool(std::uint32_t)>& spans) const {
    std::size_t of_it = 0;
    for (const Crossed& one : curve.facets) of_it += spans(one.turned[0]) ? 1 : 0;
    return 2 * of_it > curve.facets.size();
  }

  /// Into how many pieces the surface falls when it is cut along these curves.
  [[nodiscard]] std::size_t pieces(const std::vector<bool>& is_cut) const {
    std::vector<std::uint32_t> parent(vertices_.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t v) {
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      const bool parts = curve_of_[f] != kNone && is_cut[curve_of_[f]];
      const Triangle& t = facets_[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k];
        const std::uint32_t b = t[(k + 1) % 3];
        if (!parts || is_high(a) == is_high(b)) parent[root(a)] = root(b);
      }
    }
    std::vector<bool> is_used(vertices_.size(), false);
    for (const Triangle& t : facets_) {
      for (const std::uint32_t v : t) is_used[v] = true;
    }
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < vertices_.size(); ++v)
      count += is_used[v] && root(v) == v ? 1 : 0;
    return count;
  }

  void cut(const Curve& curve, PartedBridges& parted) const {
    // The cut's vertex on an edge, on the side of its first end.
    std::map<Edge, std::uint32_t> made;
    const auto on = [&](std::uint32_t from, std::uint32_t to) {
      const auto next = static_cast<std::uint32_t>(vertices_.size() + parted.cuts.size());
      const auto [at, is_new] = made.try_emplace({from, to}, next);
      if (is_new) parted.cuts.push_back({from, to, share_of(from, to)});
      return at->second;
    };
    // What closes each side goes the other way along its border.
    std::map<std::uint32_t, std::uint32_t> next_low;
    std::map<std::uint32_t, std::uint32_t> next_high;
    std::map<std::uint32_t, Vec3> at;
    for (const Crossed& one : curve.facets) {
      const auto [p, q, r] = one.turned;
      const std::uint32_t pq = on(p, q);
      const std::uint32_t pr = on(p, r);
      const std::uint32_t qp = on(q, p);
      const std::uint32_t rp = on(r, p);
      parted.facets.push_back({p, pq, pr});
      parted.facets.push_back({q, r, rp});
      parted.facets.push_back({q, rp, qp});
      (is_high(p) ? next_high : next_low)[pr] = pq;
      (is_high(p) ? next_low : next_high)[qp] = rp;
      at[pq] = at[qp] = crossing(edge_of(p, q));
      at[pr] = at[rp] = crossing(edge_of(p, r));
    }
    for (const auto* next : {&next_low, &next_high}) {
      std::vector<std::uint32_t> border;
      for (std::uint32_t v = next->begin()->first; border.size() < next->size(); v = next->at(v)) {
        border.push_back(v);
      }
      close(border, at, parted.facets);
    }
  }

  /// The triangulation of least area [barequet1995filling].
  static void close(const std::vector<std::uint32_t>& border,
                    const std::map<std::uint32_t, Vec3>& at,
                    std::vector<Triangle>& facets) {
    const std::size_t n = border.size();
    std::vector<Vec3> p;
    for (const std::uint32_t v : border) p.push_back(at.at(v));
    std::vector<double> least(n * n, 0.0);
    std::vector<std::uint32_t> by(n * n, 0);
    for (std::size_t span = 2; span < n; ++span) {
      for (std::size_t i = 0; i + span < n; ++i) {
        const std::size_t j = i + span;
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t m = i + 1; m < j; ++m) {
          const double area = 0.5 * length(cross(p[m] - p[i], p[j] - p[i]));
          const double sum = least[i * n + m] + least[m * n + j] + area;
          if (sum >= best) continue;
          best = sum;
          by[i * n + j] = static_cast<std::uint32_t>(m);
        }
        least[i * n + j] = best;
      }
    }
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j - i < 2) continue;
      const std::size_t m = by[i * n + j];
      facets.push_back({border[i], border[m], border[j]});
      open.emplace_back(i, m);
      open.emplace_back(m, j);
    }
  }

  std::span<const Vec3> vertices_;
  const std::vector<Triangle>& facets_;
  std::span<const float> level_;
  std::vector<std::size_t> curve_of_;  ///< by facet
  std::vector<Curve> curves_;
};

}  // namespace

PartedBridges part_bridges(std::span<const Vec3> vertices,
                           const std::vector<Triangle>& facets,
                           std::span<const float> level,
                           const std::function<bool(std::uint32_t)>& spans) {
  if (level.size() != vertices.size()) {
    throw InvalidInput("part_bridges: a level is wanted for each vertex");
  }
  return Parting(vertices, facets, level).part(spans);
}

}  // namespace carpus::mesh

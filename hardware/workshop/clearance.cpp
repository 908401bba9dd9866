// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hardware/workshop/clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "geometry/aabb.hpp"

namespace carpus::hardware {
namespace {

using Corners = std::array<Vec3, 3>;

double segment_distance(const Vec3& p, const Vec3& p_end, const Vec3& q, const Vec3& q_end) {
  // Closest points of two segments by clamping [ericson2004realtime] §5.1.9.
  const Vec3 d1 = p_end - p;
  const Vec3 d2 = q_end - q;
  const Vec3 r = p - q;
  const double a = dot(d1, d1);
  const double e = dot(d2, d2);
  const double f = dot(d2, r);
  const double c = dot(d1, r);
  const double b = dot(d1, d2);
  const double det = a * e - b * b;
  double s = det > 1e-12 * a * e ? std::clamp((b * f - c * e) / det, 0.0, 1.0) : 0.0;
  double t = e > 0 ? (b * s + f) / e : 0.0;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = a > 0 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0.0;
  }
  return distance(p + d1 * s, q + d2 * t);
}

/// Where the foot of `p` lies in the triangle: the distance to its plane; else a great number.
double height_over(const Vec3& p, const Corners& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double area = length(n);
  if (!(area > 0)) return 1e9;
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), n) < 0) return 1e9;
  }
  return std::abs(dot(p - t[0], n)) / area;
}

bool pierces(const Vec3& from, const Vec3& to, const Corners& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double one = dot(from - t[0], n);
  const double other = dot(to - t[0], n);
  if (!(one * other < 0)) return false;
  const Vec3 at = from + (to - from) * (one / (one - other));
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(cross(t[(i + 1) % 3] - t[i], at - t[i]), n) < 0) return false;
  }
  return true;
}

}  // namespace

/// A tree of boxes over a mesh's triangles; leaves of up to eight.
class Clearance::Tree {
 public:
  explicit Tree(const TriangleMesh& mesh) {
    for (const Triangle& f : mesh.facets)
      triangles_.push_back({mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]});
    nodes_.reserve(triangles_.size());
    grow(0, triangles_.size());
  }
  [[nodiscard]] const Aabb& bounds() const { return nodes_[0].box; }

  /// @return the distance, or `most` where it is no less.
  [[nodiscard]] double distance_to(const Tree& other, double most) const {
    visit(0, other, 0, most);
    return most;
  }

 private:
  struct Node {
    Aabb box;
    std::size_t from = 0;
    std::size_t to = 0;
    std::size_t right = 0;  ///< 0: a leaf; the left one follows at once
  };

  std::size_t grow(std::size_t from, std::size_t to) {
    const std::size_t index = nodes_.size();
    nodes_.push_back({{}, from, to, 0});
    for (std::size_t i = from; i < to; ++i) {
      for (const Vec3& p : triangles_[i]) nodes_[index].box.include(p);
    }
    if (to - from <= 8) return index;
    const Vec3 size = nodes_[index].box.extent();
    const std::size_t axis =
        size.x > size.y ? (size.x > size.z ? 0U : 2U) : (size.y > size.z ? 1U : 2U);
    const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(from);
    const auto middle = begin + static_cast<std::ptrdiff_t>((to - from) / 2);
    std::nth_element(begin, middle, triangles_.begin() + static_cast<std::ptrdiff_t>(to),
                     [axis](const Corners& a, const Corners& b) {
                       return a[0][axis] + a[1][axis] + a[2][axis] <
                              b[0][axis] + b[1][axis] + b[2][axis];
                     });
    grow(from, from + (to - from) / 2);
    const std::size_t right = grow(from + (to - from) / 2, to);
    nodes_[index].right = right;
    return index;
  }

  void visit(std::size_t mine, const Tree& other, std::size_t theirs, double& most) const {
    const Node& a = nodes_[mine];
    const Node& b = other.nodes_[theirs];
    if (most <= 0 || !a.box.grown(most).overlaps(b.box)) return;
    if (a.right == 0 && b.right == 0) {
      for (std::size_t i = a.from; i < a.to; ++i) {
        for (std::size_t k = b.from; k < b.to; ++k)
          most = std::min(most, triangle_distance(triangles_[i], other.triangles_[k]));
      }
    } else if (b.right == 0 || (a.right != 0 && a.to - a.from > b.to - b.from)) {
      visit(mine + 1, other, theirs, most);
      visit(a.right, other, theirs, most);
    } else {
      visit(mine, other, theirs + 1, most);
      visit(mine, other, b.right, most);
    }
  }

  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

double triangle_distance(const Corners& a, const Corners& b) {
  double least = 1e9;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& a_end = a[(i + 1) % 3];
    const Vec3& b_end = b[(i + 1) % 3];
    if (pierces(a[i], a_end, b) || pierces(b[i], b_end, a)) return 0;
    least = std::min({least, height_over(a[i], b), height_over(b[i], a)});
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, segment_distance(a[i], a_end, b[k], b[(k + 1) % 3]));
  }
  return least;
}

bool is_joint(const std::string& one, const std::string& other) {
  static const std::set<std::pair<std::string, std::string>> joints{
      {"ball", "magnet"},
      {"ball", "rod_end"},
      {"bearing", "shaft"},
      {"horn", "servo"},
      {"gimbal_ring", "platform"},
      {"carrier", "gimbal_ring"},
      {"carrier", "retaining_ring"},
      {"carrier", "tool_shaft"},
      {"carrier", "tool_handle"},
      {"scope_grip", "tool_shaft"},
      {"light_post", "scope_grip"},
      {"portal_frame", "tool_shaft"},
      {"silicone", "tool_shaft"},
      {"silicone", "tool_tip"},
      {"drum", "leg_b"},
      // The slot, whose play is its purpose; that it is as wide as it shall be has a test of its
      // own.
      {"fork", "leg_a"},
      // Inside the patient the screen draws, not the shell.
      {"potentiometer", "potentiometer_shaft"},
      {"cord", "mast_screw"},
      {"roll_sensor", "tool_shaft"},
      {"tool_shaft", "wrist_shell"},
      {"tool_tip", "wrist_shell"},
      {"portal_frame", "tool_tip"},
  };
  return joints.contains(std::minmax(one, other));
}

Clearance::Clearance() = default;
Clearance::~Clearance() = default;

std::vector<Nearness> Clearance::near_pairs(const std::vector<Piece>& pieces, double horizon_mm) {
  trees_.resize(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].group != Group::Base || !trees_[i]) {
      trees_[i] = std::make_unique<Tree>(pieces[i].mesh);
    }
  }
  std::vector<Nearness> found;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t k = i + 1; k < pieces.size(); ++k) {
      // What is screwed to the plate keeps clear of what belongs to another leg, too.
      const bool are_neighbours =
          pieces[i].leg >= 0 && pieces[k].leg >= 0 && pieces[i].leg != pieces[k].leg;
      if (pieces[i].group == pieces[k].group && !are_neighbours) continue;
      if (!are_neighbours && is_joint(pieces[i].name, pieces[k].name)) continue;
      if (!trees_[i]->bounds().grown(horizon_mm).overlaps(trees_[k]->bounds())) continue;
      const double away = trees_[i]->distance_to(*trees_[k], horizon_mm);
      if (away < horizon_mm) found.push_back({pieces[i].name, pieces[k].name, away});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Nearness& a, const Nearness& b) { return a.distance_mm < b.distance_mm; });
  return found;
}

}  // namespace carpus::hardware

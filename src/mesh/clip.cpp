// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Height of every vertex over the plane -> whole facets kept or dropped, crossed ones cut at points
// that belong to edges -> renumbering.
#include "mesh/clip.hpp"

#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace carpus::mesh {
namespace {

class Clipper {
 public:
  Clipper(const TriangleMesh& mesh, const Vec3& point, const Vec3& normal)
      : mesh_(mesh), number_(mesh.vertices.size(), kUnused) {
    heights_.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) heights_.push_back(dot(v - point, normal));
  }

  TriangleMesh run() {
    for (const Triangle& t : mesh_.facets) add(t);
    return std::move(result_);
  }

 private:
  static constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] bool is_kept(std::uint32_t v) const { return heights_[v] >= 0; }

  std::uint32_t vertex(std::uint32_t v) {
    if (number_[v] == kUnused) {
      number_[v] = static_cast<std::uint32_t>(result_.vertices.size());
      result_.vertices.push_back(mesh_.vertices[v]);
    }
    return number_[v];
  }

  /// Where the edge from a kept to a dropped vertex meets the plane.
  std::uint32_t cut(std::uint32_t kept, std::uint32_t dropped) {
    const auto [it, is_new] =
        cuts_.try_emplace({kept, dropped}, static_cast<std::uint32_t>(result_.vertices.size()));
    if (is_new) {
      const double along = heights_[kept] / (heights_[kept] - heights_[dropped]);
      const Vec3& from = mesh_.vertices[kept];
      result_.vertices.push_back(from + (mesh_.vertices[dropped] - from) * along);
    }
    return it->second;
  }

  void add(const Triangle& t) {
    const int kept = int{is_kept(t[0])} + int{is_kept(t[1])} + int{is_kept(t[2])};
    if (kept == 0) return;
    if (kept == 3) {
      result_.facets.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
      return;
    }
    // Turned so that the corner that differs from the others comes first.
    std::size_t first = 0;
    while (is_kept(t[first]) != (kept == 1)) ++first;
    const std::uint32_t a = t[first];
    const std::uint32_t b = t[(first + 1) % 3];
    const std::uint32_t c = t[(first + 2) % 3];
    if (kept == 1) {
      const std::uint32_t corner = vertex(a);
      const std::uint32_t ab = cut(a, b);
      result_.facets.push_back({corner, ab, cut(a, c)});
      return;
    }
    const std::uint32_t ab = cut(b, a);
    const std::uint32_t ca = cut(c, a);
    const std::uint32_t nb = vertex(b);
    const std::uint32_t nc = vertex(c);
    result_.facets.push_back({ab, nb, nc});
    result_.facets.push_back({ab, nc, ca});
  }

  const TriangleMesh& mesh_;
  std::vector<double> heights_;
  std::vector<std::uint32_t> number_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cuts_;
  TriangleMesh result_;
};

}  // namespace

TriangleMesh clipped(const TriangleMesh& mesh, const Vec3& point, const Vec3& normal) {
  return Clipper(mesh, point, normal).run();
}

}  // namespace carpus::mesh

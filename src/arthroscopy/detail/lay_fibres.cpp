// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The nearest ligament, evened out over a place's surroundings -> two rings more about it -> across
// and along the strands that the place lies between.
#include "arthroscopy/detail/lay_fibres.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "mesh/neighbours.hpp"

namespace carpus::arthroscopy::detail {
namespace {

using soft_tissue::Lining;

constexpr double kFarMm = 4.0;
constexpr double kNextLigamentMm = 37.0;  ///< wider than any: no two show the same bundles
constexpr int kEvenedTimes = 4;
constexpr int kRimRings = 2;

struct OnStrand {
  Vec3 at;
  double mm = kFarMm;
  double along_mm = 0;
};

OnStrand nearest_on(const soft_tissue::Strand& strand, const Vec3& p, double reach_mm) {
  OnStrand best;
  best.mm = reach_mm;
  double before = 0;
  for (std::size_t i = 0; i + 1 < strand.course.size(); ++i) {
    const Vec3& a = strand.course[i];
    const Vec3 way = strand.course[i + 1] - a;
    const double t = std::clamp(dot(p - a, way) / std::max(squared_length(way), 1e-12), 0.0, 1.0);
    const double mm = distance(p, a + way * t);
    if (mm < best.mm) best = {a + way * t, mm, before + t * length(way)};
    before += length(way);
  }
  return best;
}

double mm_to(const soft_tissue::Ligament& ligament, const Vec3& p) {
  double mm = kFarMm;
  for (const soft_tissue::Strand& strand : ligament.strands) {
    mm = std::min(mm, nearest_on(strand, p, mm).mm);
  }
  return mm;
}

/// Across and along the strands. Between two a place lies by its shares of the way from one to the
/// other, so that neither coordinate jumps.
Vec3 fibre_at(const soft_tissue::Ligament& ligament, const Vec3& p) {
  const auto& strands = ligament.strands;
  std::size_t nearest = 0;
  OnStrand on;
  for (std::size_t s = 0; s < strands.size(); ++s) {
    const OnStrand here = nearest_on(strands[s], p, on.mm);
    if (here.mm >= on.mm) continue;
    nearest = s;
    on = here;
  }
  const double apart_mm =
      strands.size() > 1 ? ligament.width_mm / static_cast<double>(strands.size() - 1) : 0;
  auto across = static_cast<double>(nearest);
  double along_mm = on.along_mm;
  for (const int side : {-1, 1}) {
    if (side < 0 ? nearest == 0 : nearest + 1 == strands.size()) continue;
    const OnStrand next =
        nearest_on(side < 0 ? strands[nearest - 1] : strands[nearest + 1], p, 1e9);
    const Vec3 way = next.at - on.at;
    const double t = dot(p - on.at, way) / std::max(squared_length(way), 1e-12);
    if (t <= 0) continue;
    across += side * std::min(t, 1.0);
    along_mm += std::min(t, 1.0) * (next.along_mm - on.along_mm);
    break;
  }
  return {across * apart_mm, along_mm, 0};
}

/// The mean of each vertex and its neighbours, some times.
template <typename T>
void even_out(std::vector<T>& values, const mesh::Neighbours& neighbours, int times) {
  for (int time = 0; time < times; ++time) {
    const std::vector<T> before = values;
    for (std::size_t v = 0; v < values.size(); ++v) {
      T sum = before[v];
      for (const std::uint32_t n : neighbours.of(v)) sum += before[n];
      values[v] = sum / static_cast<T>(neighbours.of(v).size() + 1);
    }
  }
}

constexpr std::size_t kNoLigament = static_cast<std::size_t>(-1);

/// By vertex which ligament lines the wall there: the nearest, in the mean of a place's
/// surroundings, since where two lie in each other the nearest changes from vertex to vertex.
std::vector<std::size_t> ligaments_on(const TriangleMesh& wall,
                                      const std::vector<Lining>& lining,
                                      const soft_tissue::SoftTissue& tissue,
                                      const mesh::Neighbours& neighbours) {
  const auto& vertices = wall.vertices;
  std::vector<std::size_t> nearest(vertices.size(), kNoLigament);
  std::vector<double> least(vertices.size(), kFarMm);
  for (std::size_t l = 0; l < tissue.ligaments.size(); ++l) {
    std::vector<double> mm(vertices.size(), kFarMm);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (lining[v] == Lining::Ligament) mm[v] = mm_to(tissue.ligaments[l], vertices[v]);
    }
    even_out(mm, neighbours, kEvenedTimes);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (lining[v] != Lining::Ligament || mm[v] >= least[v]) continue;
      least[v] = mm[v];
      nearest[v] = l;
    }
  }
  return nearest;
}

/// Also what lies beside a ligament, so that its fibres run out under what lines the wall there.
std::vector<std::size_t> with_rim(std::vector<std::size_t> ligament,
                                  const mesh::Neighbours& neighbours) {
  for (int ring = 0; ring < kRimRings; ++ring) {
    const std::vector<std::size_t> before = ligament;
    for (std::size_t v = 0; v < before.size(); ++v) {
      for (const std::uint32_t n : neighbours.of(v)) {
        if (ligament[v] == kNoLigament) ligament[v] = before[n];
      }
    }
  }
  return ligament;
}

/// How far a vertex is from any that another ligament or none lines: 0 there, 1 well within.
std::vector<float> within(const std::vector<std::size_t>& ligament,
                          const mesh::Neighbours& neighbours) {
  std::vector<float> share(ligament.size());
  for (std::size_t v = 0; v < ligament.size(); ++v) {
    const auto& about = neighbours.of(v);
    const bool is_rim = std::any_of(about.begin(), about.end(), [&](std::uint32_t n) {
      return ligament[n] != ligament[v] && ligament[n] != kNoLigament;
    });
    share[v] = ligament[v] != kNoLigament && !is_rim ? 1.0F : 0.0F;
  }
  even_out(share, neighbours, 1);
  return share;
}

}  // namespace

LaidFibres lay_fibres(const TriangleMesh& wall,
                      const std::vector<Lining>& lining,
                      const soft_tissue::SoftTissue& tissue) {
  const mesh::Neighbours neighbours(wall);
  const std::vector<std::size_t> lines = ligaments_on(wall, lining, tissue, neighbours);
  const std::vector<std::size_t> woven = with_rim(lines, neighbours);
  const std::vector<float> weave = within(woven, neighbours);
  LaidFibres laid;
  for (std::size_t v = 0; v < wall.vertices.size(); ++v) {
    laid.ligament.push_back(lines[v] == kNoLigament ? nullptr : &tissue.ligaments[lines[v]]);
    Vec3 fibre;
    if (woven[v] != kNoLigament) {
      fibre = fibre_at(tissue.ligaments[woven[v]], wall.vertices[v]);
      fibre.x += kNextLigamentMm * static_cast<double>(woven[v]);
      fibre.z = weave[v];
    }
    laid.fibre.push_back(fibre);
  }
  return laid;
}

}  // namespace carpus::arthroscopy::detail

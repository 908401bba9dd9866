// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. The CT along each vertex's normal, averaged over its neighbours. 2. The highest value of each:
// the cortex. 3. Where the profile falls through the edge's height, next to the surface. 4. These
// shifts, averaged over neighbours, for the vertices that have one.
#include "reconstruct/sharpen_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "fields/triangle_tree.hpp"
#include "geometry/aabb.hpp"
#include "geometry/trilinear.hpp"
#include "mesh/neighbours.hpp"
#include "mesh/normals.hpp"
#include "mesh/self_intersection.hpp"

namespace carpus::reconstruct {
namespace {

constexpr double kStepMm = 0.1;
constexpr int kWithin = 16;  ///< steps into the bone
constexpr int kBeyond = 10;  ///< steps out of it
/// The cortex is looked for from here to there [steps].
constexpr int kDeepest = -12;
constexpr int kShallowest = 4;
constexpr int kProfilePasses = 1;
constexpr int kShiftPasses = 4;
constexpr int kRoundsWithCrossings = 6;
/// Of the room between two bones each leaves half of this at least [mm].
constexpr double kApartMm = 0.03;
/// Of the bones' places so many have a thinner cortex than the one that is taken for thick.
constexpr double kThickQuantile = 0.75;
/// Metal and ivory count as no more than so much of a thick cortex.
constexpr double kMostOfThick = 1.25;

/// The CT along a normal; NaN-free where `is_whole`.
struct Profile {
  std::array<float, kWithin + kBeyond + 1> hu{};
  bool is_whole = true;

  /// @param k  steps beyond the surface
  [[nodiscard]] float at(int k) const { return hu[static_cast<std::size_t>(k + kWithin)]; }
  [[nodiscard]] double cortex() const {
    float most = at(kDeepest);
    for (int k = kDeepest; k <= kShallowest; ++k) most = std::max(most, at(k));
    return static_cast<double>(most);
  }
};

std::vector<Profile> profiles_across(const TriangleMesh& surface,
                                     const std::vector<Vec3>& normals,
                                     const GridView<const std::int16_t>& ct) {
  std::vector<Profile> profiles(normals.size());
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    for (int k = -kWithin; k <= kBeyond; ++k) {
      const double hu = sample_at(ct, surface.vertices[i] + normals[i] * (k * kStepMm),
                                  std::numeric_limits<double>::quiet_NaN());
      profiles[i].is_whole = profiles[i].is_whole && !std::isnan(hu);
      profiles[i].hu[static_cast<std::size_t>(k + kWithin)] = static_cast<float>(hu);
    }
  }
  return profiles;
}

void average(std::vector<Profile>& profiles, const mesh::Neighbours& neighbours) {
  const std::vector<Profile> before = profiles;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    if (!before[i].is_whole) continue;
    Profile sum = before[i];
    float count = 1;
    for (const std::uint32_t other : neighbours.of(i)) {
      if (!before[other].is_whole) continue;
      for (std::size_t k = 0; k < sum.hu.size(); ++k) sum.hu[k] += before[other].hu[k];
      count += 1;
    }
    for (float& hu : sum.hu) hu /= count;
    profiles[i] = sum;
  }
}

/// Where the profile falls through `height`, next to the surface [mm]; NaN where it does not within
/// `farthest_mm`. Beyond the darkest place outside lies another bone.
double edge_of(const Profile& profile, double height, double farthest_mm) {
  int darkest = 0;
  for (int k = 0; k <= kBeyond; ++k) {
    if (profile.at(k) < profile.at(darkest)) darkest = k;
  }
  double nearest = std::numeric_limits<double>::quiet_NaN();
  for (int k = -kWithin; k < darkest; ++k) {
    const auto a = static_cast<double>(profile.at(k));
    const auto b = static_cast<double>(profile.at(k + 1));
    if (!(a >= height && b < height)) continue;
    const double mm = kStepMm * (k + (a - height) / (a - b));
    if (std::abs(mm) <= farthest_mm && !(std::abs(mm) >= std::abs(nearest))) nearest = mm;
  }
  return nearest;
}

/// Averages over neighbours that are known; what is not takes theirs, but for what is `fixed`.
void average(std::vector<double>& shifts,
             const std::vector<Profile>& profiles,
             const mesh::Neighbours& neighbours) {
  const std::vector<double> before = shifts;
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    if (!profiles[i].is_whole) continue;
    double sum = 0;
    double count = 0;
    const auto add = [&](std::size_t vertex) {
      if (std::isnan(before[vertex])) return;
      sum += before[vertex];
      count += 1;
    };
    add(i);
    for (const std::uint32_t other : neighbours.of(i)) add(other);
    if (count > 0) shifts[i] = sum / count;
  }
}

/// A surface as it was, with what is known across it.
struct Crossed {
  mesh::Neighbours neighbours;
  fields::TriangleTree tree;
  Aabb box;
  std::vector<Vec3> normals;
  std::vector<Profile> profiles;
};

double thick_cortex(const std::vector<std::optional<Crossed>>& all) {
  std::vector<double> values;
  for (const auto& surface : all) {
    for (const Profile& profile : surface->profiles) {
      if (profile.is_whole) values.push_back(profile.cortex());
    }
  }
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(
                                       kThickQuantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// How far each vertex lies within the edge [mm].
std::vector<double> shifts_of(const Crossed& crossed,
                              double thick,
                              double soft_tissue_hu,
                              const SharpenOptions& options) {
  const double thick_range = thick - soft_tissue_hu;
  std::vector<double> shifts(crossed.profiles.size());
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    const Profile& profile = crossed.profiles[i];
    if (!profile.is_whole) continue;  // stays, and holds what is beside it
    const double range = std::min(profile.cortex() - soft_tissue_hu, kMostOfThick * thick_range);
    shifts[i] = std::numeric_limits<double>::quiet_NaN();
    if (!(range > 0)) continue;
    const double part =
        std::clamp(options.thick_edge * thick_range / range, options.thick_edge, options.thin_edge);
    shifts[i] = edge_of(profile, soft_tissue_hu + part * range, options.farthest_mm);
  }
  for (int pass = 0; pass < kShiftPasses; ++pass) {
    average(shifts, crossed.profiles, crossed.neighbours);
  }
  for (double& shift : shifts) {
    if (std::isnan(shift)) shift = 0;
  }
  return shifts;
}

/// Two bones that move towards each other each have half of the way between them.
void keep_apart(const TriangleMesh& surface,
                std::size_t own,
                const std::vector<std::optional<Crossed>>& all,
                std::vector<double>& shifts) {
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    if (!(shifts[i] > 0)) continue;
    double nearest = 2 * (shifts[i] + kApartMm);
    for (std::size_t other = 0; other < all.size(); ++other) {
      if (other == own || !all[other]->box.grown(nearest).contains(surface.vertices[i])) continue;
      const auto hit = all[other]->tree.nearest(surface.vertices[i], nearest);
      if (hit) nearest = std::sqrt(hit->squared_distance);
    }
    shifts[i] = std::min(shifts[i], std::max(0.0, 0.5 * nearest - kApartMm));
  }
}

/// The surface with its vertices moved, but for those where it would cross itself.
TriangleMesh moved(const TriangleMesh& surface,
                   const Crossed& crossed,
                   std::vector<double> shifts) {
  for (int round = 0; round < kRoundsWithCrossings; ++round) {
    TriangleMesh result = surface;
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      result.vertices[i] += crossed.normals[i] * shifts[i];
    }
    const std::vector<std::uint32_t> crossing = mesh::crossing_facets(result);
    if (crossing.empty()) return result;
    for (const std::uint32_t facet : crossing) {
      for (const std::uint32_t v : surface.facets[facet]) {
        shifts[v] = 0;
        for (const std::uint32_t other : crossed.neighbours.of(v)) shifts[other] *= 0.5;
      }
    }
  }
  return surface;
}

}  // namespace

void sharpen_surfaces(std::span<TriangleMesh* const> surfaces,
                      const GridView<const std::int16_t>& ct,
                      double soft_tissue_hu,
                      const SharpenOptions& options) {
  std::vector<std::optional<Crossed>> crossed(surfaces.size());
  parallel_for(surfaces.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Crossed c{mesh::Neighbours(*surfaces[i]),
                fields::TriangleTree(*surfaces[i]),
                bounds_of(surfaces[i]->vertices),
                mesh::vertex_normals(*surfaces[i]),
                {}};
      c.profiles = profiles_across(*surfaces[i], c.normals, ct);
      for (int pass = 0; pass < kProfilePasses; ++pass) average(c.profiles, c.neighbours);
      crossed[i] = std::move(c);
    }
  });
  const double thick = thick_cortex(crossed);
  if (!(thick > soft_tissue_hu)) return;
  parallel_for(surfaces.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<double> shifts = shifts_of(*crossed[i], thick, soft_tissue_hu, options);
      keep_apart(*surfaces[i], i, crossed, shifts);
      *surfaces[i] = moved(*surfaces[i], *crossed[i], std::move(shifts));
    }
  });
}

}  // namespace carpus::reconstruct

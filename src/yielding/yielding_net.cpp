// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Net: vertices thinned to a spacing, neighbours within 2.2 of it joined. Step: predict, springs
// and foundation by their compliance, tips last, velocity from what was moved; several times a
// tick.
#include "yielding/yielding_net.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/units.hpp"

namespace carpus::yielding {
namespace {

constexpr int kSmallSteps = 8;
constexpr double kNeighbours = 2.2;  // of the spacing
/// 1 N = 1e6 g mm/s2.
constexpr double kGramsPerNewton = 1e6;
constexpr double kHookCompliance = 0.05;  // mm/N: of the hook in the tissue
constexpr double kStillMmPerS = 0.05;
constexpr double kStillMm = 1e-4;
constexpr double kFarthestMm = 6.0;  // from where it rests: tissue tears before [E]

}  // namespace

Net::Net(const TriangleMesh& sheet,
         const Vec3& towards,
         const Material& material,
         double spacing_mm)
    : spacing_mm_(spacing_mm),
      along_mm_per_n_(1 / material.along_n_per_mm),
      damping_per_s_(material.damping_per_s) {
  std::vector<Vec3> normals(sheet.vertices.size());
  std::vector<int> rim(sheet.vertices.size());
  double area = 0;
  Vec3 all;
  for (const Triangle& f : sheet.facets) {
    const Vec3 twice = cross(sheet.vertices[f[1]] - sheet.vertices[f[0]],
                             sheet.vertices[f[2]] - sheet.vertices[f[0]]);
    area += length(twice) / 2;
    for (const std::uint32_t v : f) normals[v] += twice;
    all += twice;
  }
  const double sign = dot(all, towards) < 0 ? -1.0 : 1.0;
  // An edge of one facet alone is the rim.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& f : sheet.facets) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.emplace_back(std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3]));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool has_twin =
        (i > 0 && edges[i - 1] == edges[i]) || (i + 1 < edges.size() && edges[i + 1] == edges[i]);
    if (!has_twin) rim[edges[i].first] = rim[edges[i].second] = 1;
  }
  const auto is_free = [&](const Vec3& at) {
    return std::none_of(rest_.begin(), rest_.end(),
                        [&](const Vec3& taken) { return distance(taken, at) < spacing_mm; });
  };
  // The rim first: it is held, and stays where it is.
  for (const int of_rim : {1, 0}) {
    for (std::size_t v = 0; v < sheet.vertices.size() && rest_.size() < kMaxParticles; ++v) {
      if (rim[v] != of_rim || !is_free(sheet.vertices[v])) continue;
      rest_.push_back(sheet.vertices[v]);
      normals_.push_back(normalized_or(normals[v] * sign, {0, 0, 1}));
      is_held_.push_back(of_rim == 1);
    }
  }
  const double each_mm2 = rest_.empty() ? 0 : area / static_cast<double>(rest_.size());
  mass_g_ = material.mass_g_per_mm2 * each_mm2;
  const double foundation = material.foundation_n_per_mm2 * each_mm2;
  foundation_mm_per_n_.assign(rest_.size(), foundation > 0 ? 1 / foundation : 0);
  has_come_off_.assign(rest_.size(), false);
  join(1);
}

/// Neighbours, as far apart as they rest; what is held at both ends needs no spring.
void Net::join(double left_share) {
  springs_.clear();
  for (std::size_t a = 0; a < rest_.size(); ++a) {
    for (std::size_t b = a + 1; b < rest_.size(); ++b) {
      const double far = distance(rest_[a], rest_[b]);
      if (far > kNeighbours * spacing_mm_ || (is_held_[a] && is_held_[b])) continue;
      const double left = has_come_off_[a] || has_come_off_[b] ? left_share : 1.0;
      springs_.push_back({static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b), far,
                          along_mm_per_n_ / left});
    }
  }
}

void Net::come_off(const Vec3& from,
                   const Vec3& to,
                   double radius_mm,
                   double left_share,
                   double rests_off_mm) {
  const Vec3 along = to - from;
  const double whole = squared_length(along);
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    double share = whole > 0 ? dot(rest_[i] - from, along) / whole : 0;
    share = std::clamp(share, 0.0, 1.0);
    const double off = distance(rest_[i], from + along * share);
    if (off > radius_mm) continue;
    is_held_[i] = false;
    has_come_off_[i] = true;
    if (foundation_mm_per_n_[i] > 0) foundation_mm_per_n_[i] /= left_share;
    rest_[i] += normals_[i] * (rests_off_mm * (1 - off / radius_mm));
  }
  // What lies elsewhere is as long as it lies.
  join(left_share);
}

std::size_t nearest(const Net& net, const Vec3& at) noexcept {
  std::size_t best = kMaxParticles;
  double least = 1e18;
  for (std::size_t i = 0; i < net.size(); ++i) {
    const double far = squared_length(net.rest()[i] - at);
    if (far >= least) continue;
    least = far;
    best = i;
  }
  return best;
}

void NetState::reset(const Net& net) noexcept {
  for (std::size_t i = 0; i < net.size(); ++i) {
    at_[i] = net.rest_[i];
    velocity_[i] = {};
  }
  force_ = {};
  is_still_ = true;
}

void NetState::cut(const Net& net, std::size_t i) noexcept {
  if (i >= net.size()) return;
  is_cut_[i] = true;
  at_[i] = net.rest_[i];
  velocity_[i] = {};
}

void NetState::step(const Net& net, std::span<const Tip> tips) noexcept {
  force_ = {};
  const bool is_touched =
      std::any_of(tips.begin(), tips.end(), [](const Tip& tip) { return tip.is_there; });
  if (net.size() == 0 || (is_still_ && !is_touched)) return;
  const double before = energy_n_mm(net);
  start_ = at_;
  start_velocity_ = velocity_;
  constexpr double kSmallStep = kTickSeconds / kSmallSteps;
  for (int s = 0; s < kSmallSteps; ++s) small_step(net, tips, kSmallStep);
  for (Vec3& f : force_) f = f / kSmallSteps;
  // Solved one spring after the other, a step may gain a little: left to itself it is not let.
  const double after = energy_n_mm(net);
  if (!is_touched && after > before) {
    for (std::size_t i = 0; i < net.size(); ++i) {
      at_[i] = start_[i];
      velocity_[i] = start_velocity_[i] * 0.5;
    }
  }
  bool is_still = !is_touched;
  for (std::size_t i = 0; i < net.size() && is_still; ++i) {
    is_still = length(velocity_[i]) < kStillMmPerS && distance(at_[i], net.rest_[i]) < kStillMm;
  }
  is_still_ = is_still;
  if (is_still) reset(net);
}

void NetState::small_step(const Net& net, std::span<const Tip> tips, double h) noexcept {
  const double slower = 1.0 / (1.0 + net.damping_per_s_ * h);
  const double weight = 1.0 / net.mass_g_;  // inverse mass, 1/g
  // Compliance in the units of the step: mm/N / h2, against inverse masses in mm/s2 per N.
  const double w = weight * kGramsPerNewton;
  for (std::size_t i = 0; i < net.size(); ++i) {
    before_[i] = at_[i];
    if (!net.is_held_[i]) at_[i] += velocity_[i] * (h * slower);
  }
  const double per_h2 = 1.0 / (h * h);
  for (const Net::Spring& spring : net.springs_) {
    if (is_cut_[spring.a] || is_cut_[spring.b]) continue;
    const double wa = net.is_held_[spring.a] ? 0.0 : w;
    const double wb = net.is_held_[spring.b] ? 0.0 : w;
    const Vec3 way = at_[spring.b] - at_[spring.a];
    const double far = length(way);
    if (!(far > 0) || !(wa + wb > 0)) continue;
    const double by = (far - spring.rest_mm) / (wa + wb + spring.compliance_mm_per_n * per_h2);
    const Vec3 pull = way * (by / far);
    at_[spring.a] += pull * wa;
    at_[spring.b] -= pull * wb;
  }
  for (std::size_t i = 0; i < net.size(); ++i) {
    if (net.is_held_[i] || !(net.foundation_mm_per_n_[i] > 0)) continue;
    const Vec3 off = at_[i] - net.rest_[i];
    at_[i] -= off * (w / (w + net.foundation_mm_per_n_[i] * per_h2));
  }
  for (std::size_t t = 0; t < tips.size() && t < kTips; ++t) {
    const Tip& tip = tips[t];
    if (!tip.is_there) continue;
    if (tip.hooked < net.size()) {
      if (net.is_held_[tip.hooked] || is_cut_[tip.hooked]) continue;
      const Vec3 off = at_[tip.hooked] - tip.at;
      const double by = 1.0 / (1.0 + kHookCompliance * per_h2 / w);
      at_[tip.hooked] -= off * by;
      force_[t] += off * (by * per_h2 / w);
      continue;
    }
    const double r2 = tip.radius_mm * tip.radius_mm;
    for (std::size_t i = 0; i < net.size(); ++i) {
      if (net.is_held_[i] || is_cut_[i]) continue;
      const Vec3 off = at_[i] - tip.at;
      const double high = dot(off, net.normals_[i]);
      const double aside2 = squared_length(off) - high * high;
      if (aside2 >= r2) continue;
      const double most = -std::sqrt(r2 - aside2);  // below the ball
      if (high <= most) continue;
      const double by = high - most;
      at_[i] -= net.normals_[i] * by;
      force_[t] += net.normals_[i] * (by * per_h2 / w);
    }
  }
  for (std::size_t i = 0; i < net.size(); ++i) {
    if (net.is_held_[i]) continue;
    const Vec3 off = at_[i] - net.rest_[i];
    const double far = length(off);
    if (far > kFarthestMm) at_[i] = net.rest_[i] + off * (kFarthestMm / far);
    velocity_[i] = (at_[i] - before_[i]) / h;
  }
}

double NetState::energy_n_mm(const Net& net) const noexcept {
  double springs = 0;
  for (const Net::Spring& spring : net.springs_) {
    if (is_cut_[spring.a] || is_cut_[spring.b]) continue;
    const double longer = distance(at_[spring.a], at_[spring.b]) - spring.rest_mm;
    springs += longer * longer / spring.compliance_mm_per_n;
  }
  double motion = 0;
  for (std::size_t i = 0; i < net.size(); ++i) {
    if (net.is_held_[i]) continue;
    motion += squared_length(velocity_[i]);
    if (net.foundation_mm_per_n_[i] > 0) {
      springs += squared_length(at_[i] - net.rest_[i]) / net.foundation_mm_per_n_[i];
    }
  }
  return (springs + motion * net.mass_g_ / kGramsPerNewton) / 2;
}

}  // namespace carpus::yielding

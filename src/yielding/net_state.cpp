// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Step: predict, springs and foundation by their compliance, tips last, velocity from what was
// moved; several times a tick.
#include "yielding/net_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::yielding {
namespace {

constexpr int kSmallSteps = 8;
/// 1 N = 1e6 g mm/s2.
constexpr double kGramsPerNewton = 1e6;
constexpr double kHookCompliance = 0.05;  // mm/N: of the hook in the tissue
constexpr double kStillMmPerS = 0.05;
constexpr double kStillMm = 1e-4;
constexpr double kFarthestMm = 6.0;  // from where it rests: tissue tears before [E]

}  // namespace

void NetState::rest_where_laid(const Net& net) noexcept {
  for (std::size_t i = 0; i < net.size(); ++i) {
    off_[i] = {};
    velocity_[i] = {};
  }
  force_ = {};
  is_still_ = true;
}

void NetState::reset(const Net& net) noexcept {
  rest_where_laid(net);
  for (std::size_t i = 0; i < net.size(); ++i) rest_[i] = net.rest()[i];
  if (!net.is_between_two()) return;
  for (std::size_t s = 0; s < net.springs().size(); ++s) laid_mm_[s] = net.springs()[s].rest_mm;
}

void NetState::lay(const Net& net,
                   const Pose<frame::Bone, frame::Bone>& first_from_second) noexcept {
  if (!net.is_between_two()) return;
  for (std::size_t i = 0; i < net.size(); ++i) {
    const Vec3& first = net.rest()[i];
    const Vec3 second = (first_from_second * Point<frame::Bone>{first}).v;
    rest_[i] = first + (second - first) * net.second_share(i);
  }
  for (std::size_t s = 0; s < net.springs().size(); ++s) {
    const Net::Spring& spring = net.springs()[s];
    laid_mm_[s] = distance(rest_[spring.a], rest_[spring.b]);
  }
}

double NetState::length_of(const Net& net, std::size_t spring) const noexcept {
  return net.is_between_two() ? laid_mm_[spring] : net.springs()[spring].rest_mm;
}

std::size_t NetState::nearest(const Net& net, const Vec3& at) const noexcept {
  std::size_t best = kMaxParticles;
  double least = 1e18;
  for (std::size_t i = 0; i < net.size(); ++i) {
    const double far = squared_length(rest_[i] - at);
    if (far >= least) continue;
    least = far;
    best = i;
  }
  return best;
}

void NetState::cut(const Net& net, std::size_t i) noexcept {
  if (i >= net.size()) return;
  is_cut_[i] = true;
  off_[i] = {};
  velocity_[i] = {};
}

void NetState::step(const Net& net, std::span<const Tip> tips) noexcept {
  force_ = {};
  const bool is_touched =
      std::any_of(tips.begin(), tips.end(), [](const Tip& tip) { return tip.is_there; });
  if (net.size() == 0 || (is_still_ && !is_touched)) return;
  const double before = energy_n_mm(net);
  start_velocity_ = velocity_;
  for (std::size_t i = 0; i < net.size(); ++i) at_[i] = rest_[i] + off_[i];
  constexpr double kSmallStep = kTickSeconds / kSmallSteps;
  for (int s = 0; s < kSmallSteps; ++s) small_step(net, tips, kSmallStep);
  for (Vec3& f : force_) f = f / kSmallSteps;
  std::array<Vec3, kMaxParticles>& start = before_;
  for (std::size_t i = 0; i < net.size(); ++i) {
    start[i] = off_[i];
    off_[i] = at_[i] - rest_[i];
  }
  // Solved one spring after the other, a step may gain a little: left to itself it is not let.
  const double after = energy_n_mm(net);
  if (!is_touched && after > before) {
    for (std::size_t i = 0; i < net.size(); ++i) {
      off_[i] = start[i];
      velocity_[i] = start_velocity_[i] * 0.5;
    }
  }
  bool is_still = !is_touched;
  for (std::size_t i = 0; i < net.size() && is_still; ++i) {
    is_still = length(velocity_[i]) < kStillMmPerS && length(off_[i]) < kStillMm;
  }
  is_still_ = is_still;
  if (is_still) rest_where_laid(net);
}

void NetState::pull_by_springs(const Net& net, double w, double per_h2) noexcept {
  for (std::size_t s = 0; s < net.springs().size(); ++s) {
    const Net::Spring& spring = net.springs()[s];
    if (is_cut_[spring.a] || is_cut_[spring.b]) continue;
    const double wa = net.is_held(spring.a) ? 0.0 : w;
    const double wb = net.is_held(spring.b) ? 0.0 : w;
    const Vec3 way = at_[spring.b] - at_[spring.a];
    const double far = length(way);
    if (!(far > 0) || !(wa + wb > 0)) continue;
    const double by = (far - length_of(net, s)) / (wa + wb + spring.compliance_mm_per_n * per_h2);
    const Vec3 pull = way * (by / far);
    at_[spring.a] += pull * wa;
    at_[spring.b] -= pull * wb;
    if (!(spring.level_mm_per_n > 0)) continue;
    const Vec3 off = (at_[spring.b] - rest_[spring.b]) - (at_[spring.a] - rest_[spring.a]);
    const Vec3 level = off * (1.0 / (wa + wb + spring.level_mm_per_n * per_h2));
    at_[spring.a] += level * wa;
    at_[spring.b] -= level * wb;
  }
}

void NetState::push_by_tip(const Net& net, const Tip& tip, double per_n, Vec3& force) noexcept {
  if (tip.hooked < net.size()) {
    if (net.is_held(tip.hooked) || is_cut_[tip.hooked]) return;
    const Vec3 off = at_[tip.hooked] - tip.at;
    const double by = 1.0 / (1.0 + kHookCompliance * per_n);
    at_[tip.hooked] -= off * by;
    force += off * (by * per_n);
    return;
  }
  const double r2 = tip.radius_mm * tip.radius_mm;
  const double side = tip.is_behind ? -1.0 : 1.0;
  for (std::size_t i = 0; i < net.size(); ++i) {
    if (net.is_held(i) || is_cut_[i]) continue;
    const Vec3 off = at_[i] - tip.at;
    const Vec3 normal = net.normals()[i] * side;
    const double high = dot(off, normal);
    const double aside2 = squared_length(off) - high * high;
    if (aside2 >= r2) continue;
    const double most = -std::sqrt(r2 - aside2);  // below the ball
    if (high <= most) continue;
    const double by = high - most;
    at_[i] -= normal * by;
    force += normal * (by * per_n);
  }
}

void NetState::small_step(const Net& net, std::span<const Tip> tips, double h) noexcept {
  const double slower = 1.0 / (1.0 + net.damping_per_s() * h);
  // Inverse mass in mm/s2 per N; compliance in the units of the step, mm/N / h2, stands against it.
  const double w = kGramsPerNewton / net.mass_g();
  const double per_h2 = 1.0 / (h * h);
  for (std::size_t i = 0; i < net.size(); ++i) {
    before_[i] = at_[i];
    if (!net.is_held(i)) at_[i] += velocity_[i] * (h * slower);
  }
  pull_by_springs(net, w, per_h2);
  for (std::size_t i = 0; i < net.size(); ++i) {
    const double foundation = net.foundation_mm_per_n(i);
    if (net.is_held(i) || !(foundation > 0)) continue;
    at_[i] -= (at_[i] - rest_[i]) * (w / (w + foundation * per_h2));
  }
  for (std::size_t t = 0; t < tips.size() && t < kTips; ++t) {
    if (tips[t].is_there) push_by_tip(net, tips[t], per_h2 / w, force_[t]);
  }
  for (std::size_t i = 0; i < net.size(); ++i) {
    if (net.is_held(i)) continue;
    const Vec3 off = at_[i] - rest_[i];
    const double far = length(off);
    if (far > kFarthestMm) at_[i] = rest_[i] + off * (kFarthestMm / far);
    velocity_[i] = (at_[i] - before_[i]) / h;
  }
}

double NetState::energy_n_mm(const Net& net) const noexcept {
  double springs = 0;
  for (std::size_t s = 0; s < net.springs().size(); ++s) {
    const Net::Spring& spring = net.springs()[s];
    if (is_cut_[spring.a] || is_cut_[spring.b]) continue;
    const double longer = distance(at(spring.a), at(spring.b)) - length_of(net, s);
    springs += longer * longer / spring.compliance_mm_per_n;
    if (!(spring.level_mm_per_n > 0)) continue;
    springs += squared_length(off_[spring.b] - off_[spring.a]) / spring.level_mm_per_n;
  }
  double motion = 0;
  for (std::size_t i = 0; i < net.size(); ++i) {
    if (net.is_held(i)) continue;
    motion += squared_length(velocity_[i]);
    const double foundation = net.foundation_mm_per_n(i);
    if (foundation > 0) springs += squared_length(off_[i]) / foundation;
  }
  return (springs + motion * net.mass_g() / kGramsPerNewton) / 2;
}

}  // namespace carpus::yielding

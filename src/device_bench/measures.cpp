// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "device_bench/measures.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::device_bench {
namespace {

constexpr int kSettleMs = 300;
constexpr int kHoldMs = 1200;
constexpr int kWatchMs = 500;
constexpr double kFarthestMm = 90;
constexpr double kApproachMmPerS = 40;
constexpr double kPressNPerS = 2;

/// Where the hand means to be, along the wall's normal, past the start.
void mean_to_be(Rig& rig, double mm, double mm_per_s) {
  const Vec3& n = rig.options().normal;
  rig.plant().set_intent({rig.start() - n * mm, n * -mm_per_s});
}

void settle(Rig& rig) {
  mean_to_be(rig, 0, 0);
  for (int ms = 0; ms < kSettleMs; ++ms) rig.run_ms();
}

bool is_released(const HandModel& hand) { return hand.stiffness_n_per_mm == 0; }

/// The mean of the last half second, and how far it goes both to and fro: an arm that nobody holds
/// slides one way.
struct Watch {
  double sum_force = 0;
  double sum_depth = 0;
  double least = 1e9;
  double most = -1e9;
  double rise = 0;
  double fall = 0;
  int count = 0;
  [[nodiscard]] double to_and_fro() const { return std::min(rise, fall); }
  void see(Rig& rig) {
    const double depth = rig.depth_mm();
    sum_force += rig.felt_along_n();
    sum_depth += depth;
    least = std::min(least, depth);
    most = std::max(most, depth);
    rise = std::max(rise, depth - least);
    fall = std::max(fall, most - depth);
    ++count;
  }
};

}  // namespace

bool Press::is_still(double quantum_mm) const {
  // An arm that floats off the wall does not ring on it.
  if (has_let_go && most_depth_mm < 0) return true;
  return to_and_fro_mm <= std::max(kStillMm, 3 * quantum_mm);
}

Press press(Rig& rig) {
  const bool lets_go = is_released(rig.options().hand);
  const HandModel hand = lets_go ? virtual_arm::kHandModels[2] : rig.options().hand;
  rig.plant().set_hand(hand);
  settle(rig);
  Press out;
  double mm = 0;
  double force = 0;
  while (mm < kFarthestMm) {
    const double speed =
        std::min(kApproachMmPerS,
                 force > 0.3 * kPressN ? kPressNPerS / hand.stiffness_n_per_mm : kApproachMmPerS);
    mm += speed * kTickSeconds;
    mean_to_be(rig, mm, speed);
    rig.run_ms();
    force += 0.05 * (rig.felt_along_n() - force);
    if (force < 0.25 * kPressN) out.half_depth_mm = rig.depth_mm();
    if (force >= kPressN) {
      out.has_reached = true;
      break;
    }
  }
  mean_to_be(rig, mm, 0);
  if (lets_go) rig.plant().set_hand(virtual_arm::kReleasedHand);
  Watch watch;
  for (int ms = 0; ms < kHoldMs; ++ms) {
    rig.run_ms();
    if (ms >= kHoldMs - kWatchMs) watch.see(rig);
  }
  out.force_n = watch.sum_force / watch.count;
  out.depth_mm = watch.sum_depth / watch.count;
  out.to_and_fro_mm = watch.to_and_fro();
  out.most_depth_mm = watch.most;
  out.has_let_go = lets_go;
  return out;
}

Strike strike(Rig& rig, double speed_mm_per_s) {
  constexpr double kOutsideMm = 10;
  const bool lets_go = is_released(rig.options().hand);
  const HandModel hand = lets_go ? virtual_arm::kHandModels[0] : rig.options().hand;
  rig.plant().set_hand(hand);
  settle(rig);
  rig.reset_given();
  Strike out;
  double least = 0;
  rig.on_step = [&] {
    least = std::min(least, rig.given_mj());
    out.put_in_mj = std::max(out.put_in_mj, rig.given_mj() - least);
  };
  const double deep = kOutsideMm + std::min(20.0, 4 / hand.stiffness_n_per_mm);
  const double farthest = lets_go ? 0.5 * kOutsideMm : deep;
  double mm = 0;
  const auto see = [&] {
    rig.run_ms();
    out.deepest_mm = std::max(out.deepest_mm, rig.depth_mm());
    out.pulled_back_n =
        std::max(out.pulled_back_n, rig.depth_mm() > -3 ? -rig.driven_along_n() : 0);
  };
  for (; mm < farthest; mm += speed_mm_per_s * kTickSeconds) {
    mean_to_be(rig, mm, speed_mm_per_s);
    see();
  }
  if (lets_go) {
    rig.plant().set_hand(virtual_arm::kReleasedHand);
  } else {
    mean_to_be(rig, mm, 0);
    for (int ms = 0; ms < 50; ++ms) see();
    out.pulled_back_n = 0;
    for (; mm > 0; mm -= speed_mm_per_s * kTickSeconds) {
      mean_to_be(rig, mm, -speed_mm_per_s);
      see();
    }
    mean_to_be(rig, 0, 0);
  }
  for (int ms = 0; ms < 300; ++ms) see();
  rig.on_step = nullptr;
  out.put_in_mj = -least;
  out.most_given_mj = rig.most_given_mj();
  return out;
}

double free_space_n(Rig& rig) {
  constexpr double kRateRadPerS = 3.5;
  constexpr double kAmplitudeMm = 20;  // of three ways, up to 0.1 m/s
  rig.set_wall(false);
  settle(rig);
  double sum = 0;
  int count = 0;
  for (int ms = 0; ms < 2000; ++ms) {
    const double w = kRateRadPerS;
    const double t = ms * kTickSeconds;
    const Vec3 place{kAmplitudeMm * std::sin(w * t), kAmplitudeMm * (std::cos(w * t) - 1),
                     0.7 * kAmplitudeMm * std::sin(0.7 * w * t)};
    const Vec3 velocity{kAmplitudeMm * w * std::cos(w * t), -kAmplitudeMm * w * std::sin(w * t),
                        0.49 * kAmplitudeMm * w * std::cos(0.7 * w * t)};
    rig.plant().set_intent({rig.start() + place, velocity});
    rig.run_ms();
    if (ms < 300) continue;
    sum += squared_length(rig.plant().felt_n());
    ++count;
  }
  rig.set_wall(true);
  return std::sqrt(sum / count);
}

std::vector<Sample> touch(Rig& rig) {
  constexpr double kSpeedMmPerS = 50;
  const HandModel& hand = rig.options().hand;
  settle(rig);
  const double farthest = 10 + kPressN / hand.stiffness_n_per_mm;
  std::vector<Sample> samples;
  double mm = 0;
  const auto see = [&](double speed) {
    mean_to_be(rig, mm, speed);
    rig.run_ms();
    samples.push_back({kTickSeconds * static_cast<double>(samples.size()), mm - 10, rig.depth_mm(),
                       rig.felt_along_n()});
  };
  for (; mm < farthest; mm += kSpeedMmPerS * kTickSeconds) see(kSpeedMmPerS);
  for (int ms = 0; ms < 500; ++ms) see(0);
  for (; mm > 0; mm -= kSpeedMmPerS * kTickSeconds) see(-kSpeedMmPerS);
  for (int ms = 0; ms < 200; ++ms) see(0);
  return samples;
}

}  // namespace carpus::device_bench

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/crowded_joint.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::cli {
namespace {

using simulation::Snapshot;

constexpr double kTouchesN = 0.1;
constexpr double kLeansN = 1.5;   // under what makes the scripted expert give way
constexpr double kLeansMm = 4.0;  // at most
constexpr double kLeansMmTick = 0.005;
constexpr double kSwaysN = 4.0;
constexpr double kSwaysS = 2.0;

}  // namespace

void TicksAbout::add(float us, bool happened) {
  if (happened) {
    at_.push_back(us);
    about_.insert(about_.end(), waiting_.begin(), waiting_.end());
    waiting_.clear();
    left_ = after_ + 1;
  }
  if (left_ > 0) {
    --left_;
    about_.push_back(us);
    return;
  }
  waiting_.push_back(us);
  if (waiting_.size() > before_) waiting_.erase(waiting_.begin());
}

Vec3 Leaning::next(const Snapshot& now, std::size_t hand, const Vec3& way, bool is_wanted) {
  const double force_n = length(now.hands[hand].force_in_patient);
  const double step = is_wanted && force_n < kLeansN ? kLeansMmTick : -kLeansMmTick;
  by_mm_ = std::clamp(by_mm_ + step, 0.0, kLeansMm);
  return way * by_mm_;
}

double unsteady_traction_n(double least_n, double seconds) noexcept {
  return least_n + kSwaysN * (0.5 - 0.5 * std::cos(2.0 * kPi * seconds / kSwaysS));
}

bool is_in_contact(const Snapshot& now, std::size_t hand) noexcept {
  return now.scope.facts.is_in_joint[hand] &&
         (now.hands[hand].touching || length(now.hands[hand].force_in_patient) > kTouchesN);
}

bool is_disc_moving(const Snapshot& now) noexcept {
  return now.sheet_count > 0 && !now.sheets[0].is_still;
}

std::size_t moving_ligaments(const Snapshot& now) noexcept {
  std::size_t count = 0;
  for (std::size_t s = 1; s < now.sheet_count; ++s) count += now.sheets[s].is_still ? 0 : 1;
  return count;
}

}  // namespace carpus::cli

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/passivity_net.hpp"

#include <algorithm>

namespace carpus::haptics {

double PassivityNet::share(const Vec3& force, const Vec3& tip) noexcept {
  if (!is_finite(force) || !is_finite(tip)) {
    close();
    share_ = 0;
    return 0;
  }
  if (has_tip_) given_n_mm_ += dot((force_ + force) * 0.5, tip - tip_);
  force_ = force;
  tip_ = tip;
  has_tip_ = true;
  // What was put in beyond this does not pay for what comes much later.
  given_n_mm_ = std::max(given_n_mm_, -50.0);
  if (given_n_mm_ > kNetSlackNMm) {
    if (share_ == 1) ++catches_;
    share_ = 0;
    given_n_mm_ = 0;
  } else {
    share_ = std::min(1.0, share_ + 1.0 / kNetRecoveryTicks);
  }
  return share_;
}

void PassivityNet::close() noexcept {
  given_n_mm_ = 0;
  has_tip_ = false;
  force_ = {};
}

}  // namespace carpus::haptics

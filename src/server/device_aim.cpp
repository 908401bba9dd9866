// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/device_aim.hpp"

#include "core/units.hpp"

namespace carpus::server {

bool can_aim(Aim aim, const devices::Capabilities& able) noexcept {
  if (aim == Aim::Own) return able.rotation;
  if (aim == Aim::Portal) return able.position && able.absolute;
  return true;
}

Aim best_aim(const devices::Capabilities& able) noexcept {
  if (can_aim(Aim::Own, able)) return Aim::Own;
  return can_aim(Aim::Portal, able) ? Aim::Portal : Aim::Page;
}

/// What the page says counts when it changes: else a tool that was drawn out of its portal would
/// turn back to what was said long ago.
void DeviceAim::take_pages(const Vec3& page_shaft) noexcept {
  if (page_shaft == page_shaft_) return;
  page_shaft_ = page_shaft;
  shaft_ = normalized_or(page_shaft, shaft_);
}

void DeviceAim::point_from_portal(const AimMoment& moment) noexcept {
  if (is_in_portal_ && !(distance(portal_, moment.tip) > kDrawnOutMm)) is_in_portal_ = false;
  if (!is_in_portal_) {
    take_pages(moment.page_shaft);
    if (!moment.is_at_bone || !is_finite(moment.tip)) return;
    portal_ = moment.tip + shaft_ * kPortalBehindTipMm;
    is_in_portal_ = true;
  }
  shaft_ = normalized_or(portal_ - moment.tip, shaft_);
  page_shaft_ = moment.page_shaft;
}

Vec3 DeviceAim::shaft(Aim aim,
                      const devices::Capabilities& able,
                      const AimMoment& moment) noexcept {
  const Aim used = can_aim(aim, able) ? aim : Aim::Page;
  if (used != Aim::Portal) is_in_portal_ = false;
  switch (used) {
    case Aim::Page:
      take_pages(moment.page_shaft);
      break;
    case Aim::Portal:
      point_from_portal(moment);
      break;
    case Aim::Own:
      if (able.absolute) {
        shaft_ = normalized_or(moment.own_shaft, shaft_);
      } else {
        take_pages(moment.page_shaft);
        const Vec3 turned = shaft_ + cross(moment.own_spin_rad_s, shaft_) * kTickSeconds;
        if (is_finite(turned)) shaft_ = normalized_or(turned, shaft_);
      }
      break;
  }
  return shaft_;
}

}  // namespace carpus::server

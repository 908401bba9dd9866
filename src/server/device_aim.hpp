// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the shaft of a device's hand follows: the device's own rotation where it has one; else the
// portal through which the tool went in, with the tip (arm/portal_tool.hpp: the axis is theirs); or
// what the page says, with its wheel and keys.
//
// The portal is where the tool was 25 mm behind its tip when that came to bone: skin holds it from
// then on, until it is drawn out. Before, it points where the page said last. Real-time.
#pragma once

#include <cstdint>

#include "devices/device.hpp"
#include "geometry/vec3.hpp"

namespace carpus::server {

enum class Aim : std::uint8_t { Page = 0, Portal = 1, Own = 2 };

/// From tip to portal, as a tool lies in a wrist [mm; E].
inline constexpr double kPortalBehindTipMm = 25;
/// Nearer to its portal a tip is drawn out [mm; E].
inline constexpr double kDrawnOutMm = 10;

[[nodiscard]] bool can_aim(Aim aim, const devices::Capabilities& able) noexcept;
/// What a device does best.
[[nodiscard]] Aim best_aim(const devices::Capabilities& able) noexcept;

/// One tick; frame Patient.
struct AimMoment {
  Vec3 tip;
  Vec3 page_shaft{0, 0, 1};
  Vec3 own_shaft{0, 0, 1};
  Vec3 own_spin_rad_s;
  bool is_at_bone = false;  ///< bone is near its tip, or around it
};

class DeviceAim {
 public:
  /// @return unit, from the tip to the hand. What the device cannot do is left to the page.
  [[nodiscard]] Vec3 shaft(Aim aim,
                           const devices::Capabilities& able,
                           const AimMoment& moment) noexcept;
  /// Another tool: no portal yet.
  void forget() noexcept { *this = {}; }
  [[nodiscard]] bool is_in_portal() const noexcept { return is_in_portal_; }

 private:
  void take_pages(const Vec3& page_shaft) noexcept;
  void point_from_portal(const AimMoment& moment) noexcept;

  Vec3 shaft_{0, 0, 1};
  Vec3 page_shaft_;  ///< that it said last
  Vec3 portal_;
  bool is_in_portal_ = false;
};

}  // namespace carpus::server

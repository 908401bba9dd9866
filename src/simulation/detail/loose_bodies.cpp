// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drag takes a body to the fluid's speed within some hundredths of a second: m dv/dt = c (u - v) +
// g', told by the time that it takes and the speed with which it sinks. Friction on the wall is
// Coulomb's. + - * / and sqrt alone.
#include "simulation/detail/loose_bodies.hpp"

#include <cmath>

#include "arthroscopy/make_loose_bodies.hpp"
#include "core/units.hpp"

namespace carpus::simulation::detail {
namespace {

constexpr double kTakesUpS = 0.03;       // drag of a millimetre of cartilage in water [E]
constexpr double kSinksMmPerS = 30.0;    // ... 10 % heavier [E]
constexpr double kFriction = 0.5;        // on wet cartilage with synovium on it [E]
constexpr double kCreepMmPerS = 1.0;     // slower it comes to rest
constexpr double kTouchMm = 0.02;        // so near to the wall it lies on it
constexpr double kFarthestBackMm = 0.1;  // a tick
constexpr double kPushedPerS = 10.0;     // of what a rod overlaps it becomes speed
constexpr double kInflowMmPerS = 18.0;   // at the scope's mouth [E]
constexpr double kInflowMm = 2.5;        // ... over which it spreads [E]
constexpr double kGreatestMm = 1e4;

}  // namespace

bool is_possible(const LooseState& state, std::size_t count, std::size_t portals) noexcept {
  if (state.done.there != count || state.done.out > count) return false;
  std::size_t out = 0;
  for (const LooseBody& body : state.bodies) {
    if (body.hand != kNoHand && body.hand >= procedure::kHands) return false;
    if (squared_length(body.at) > kGreatestMm * kGreatestMm ||
        squared_length(body.velocity) > kGreatestMm * kGreatestMm) {
      return false;
    }
    if (body.portal != procedure::kNoBody && body.portal >= portals) return false;
    if (body.is_out) ++out;
  }
  return out == state.done.out;
}

void drift(LooseBody& body, double radius_mm, const LooseSurroundings& around) noexcept {
  const Vec3 drive = (around.flow + around.down * kSinksMmPerS) / kTakesUpS;
  body.velocity += (drive - body.velocity / kTakesUpS) * kTickSeconds;
  const double deep = around.wall_mm + radius_mm * arthroscopy::kLiesAboveShare;
  if (around.has_wall && deep > -kTouchMm) {
    const Vec3& out = around.outwards;
    const double into = dot(body.velocity, out);
    if (into > 0) body.velocity = body.velocity - out * into;
    const double pressing = dot(drive, out);
    const double held = kFriction * (pressing > 0 ? pressing : 0.0);
    const Vec3 along = drive - out * dot(drive, out);
    const double speed = length(body.velocity);
    if (speed < kCreepMmPerS && squared_length(along) <= held * held) {
      body.velocity = {};
    } else if (speed > 0) {
      const double lost = held * kTickSeconds;
      body.velocity = lost < speed ? body.velocity * (1.0 - lost / speed) : Vec3{};
    }
    if (deep > kTouchMm / 2) {
      body.at = body.at - out * (deep < kFarthestBackMm ? deep : kFarthestBackMm);
    }
  }
  body.at += body.velocity * kTickSeconds;
}

void push_aside(LooseBody& body,
                double radius_mm,
                const Vec3& from,
                const Vec3& to,
                double rod_radius_mm) noexcept {
  const Vec3 along = to - from;
  const double whole = squared_length(along);
  double share = whole > 0 ? dot(body.at - from, along) / whole : 0.0;
  share = share < 0 ? 0 : (share > 1 ? 1 : share);
  const Vec3 off = body.at - from - along * share;
  const double far = length(off);
  const double over = radius_mm + rod_radius_mm - far;
  if (!(over > 0) || !(far > 0)) return;
  const Vec3 aside = off / far;
  body.at += aside * (over < kFarthestBackMm ? over : kFarthestBackMm);
  body.velocity += aside * (over * kPushedPerS);
}

Vec3 inflow_at(const Vec3& tip, const Vec3& shaft, const Vec3& at) noexcept {
  const Vec3 off = at - tip;
  const double far = length(off);
  if (!(far > 0)) return {};
  const double ahead = -dot(off, shaft) / far;
  if (!(ahead > 0)) return {};
  const double spread = kInflowMm / (kInflowMm + far);
  return off * (kInflowMmPerS * ahead * spread * spread / far);
}

}  // namespace carpus::simulation::detail

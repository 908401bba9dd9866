// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is near the tip, as one or two planes, rendered at the device's own rate between two frames
// of the host [adachi1995intermediate]: spring and damper into the bone, never a pull; friction by
// a place where the tip sticks until the cone is left [salcudean1997stick]. A plane that a new
// frame brings nearer rises no faster than a hand would be pushed, and an account of energy scales
// what is left [hannaford2002passivity].
#pragma once

#include "firmware/core/real.hpp"
#include "firmware/core/wire.hpp"

namespace carpus {
namespace firmware {

/// No plane rises by itself faster than this into the tip [mm/s].
constexpr float kMostRiseMmPerS = 50.0F;
/// Tangential stiffness of what sticks, of the plane's.
constexpr float kStickShare = 0.5F;
/// The account's first store: twenty microjoules [N mm].
constexpr float kFirstStoreNMm = 0.02F;
/// What an arm of flesh adds to its last move in a step: 50 m/s2 [mm/s2].
constexpr float kMostSurpriseMmPerS2 = 50000.0F;

class PlaneRenderer {
 public:
  explicit PlaneRenderer(float step_s) : step_s_(step_s) {}

  void take(const Contact& contact) { contact_ = contact; }
  /// No planes, no forces, nothing in store.
  void forget() {
    contact_ = Contact();
    stored_ = kFirstStoreNMm;
    force_ = Vector<float>();
    for (Side& side : sides_) side = Side();
    has_tip_ = false;
  }

  /// @param tip  [mm] @param velocity  filtered [mm/s] @return force on the tip [N].
  Vector<float> step(Vector<float> tip, Vector<float> velocity) {
    const Vector<float> move = has_tip_ ? tip - tip_ : Vector<float>();
    stored_ = clamped(stored_ - dot(force_, move), 0.0F, 1e6F);
    is_touching_ = false;
    Vector<float> planes;
    for (uint8_t i = 0; i < 2; ++i) planes = planes + plane_force(i, tip, velocity);
    // What the account allows: only what springs store is on it. A drill's thrust is the host's
    // own, and the arm's weight is carried also where a wall has nothing to give.
    const float press = length(planes);
    const float way =
        press > 0.0F ? dot(move, planes) / press + kMostSurpriseMmPerS2 * step_s_ * step_s_ : 0.0F;
    if (is_touching_ && way > 0.0F && press * way > stored_) {
      planes = planes * (stored_ / (press * way));
      ++scaled_;
    }
    Vector<float> force = planes + vibration() +
                          Vector<float>(static_cast<float>(contact_.force_mn[0]) * 0.001F,
                                        static_cast<float>(contact_.force_mn[1]) * 0.001F,
                                        static_cast<float>(contact_.force_mn[2]) * 0.001F);
    const float limit = static_cast<float>(contact_.limit_mn) * 0.001F;
    const float size = length(force);
    if (size > limit) {
      force = force * (limit / size);
      planes = planes * (limit / size);
    }
    if (!is_touching_ && stored_ > kFirstStoreNMm) stored_ = kFirstStoreNMm;
    tip_ = tip;
    has_tip_ = true;
    force_ = planes;
    return force;
  }

  /// Steps in which the account took force away, since the start.
  uint32_t scaled() const { return scaled_; }

 private:
  struct Side {
    Vector<float> normal;
    float offset = 0.0F;  ///< along the normal
    Vector<float> anchor;
    bool has_offset = false;
    bool sticks = false;
  };

  Vector<float> plane_force(uint8_t i, Vector<float> tip, Vector<float> velocity) {
    Side& side = sides_[i];
    const float stiffness = static_cast<float>(contact_.stiffness_n_per_m[i]) * 0.001F;  // N/mm
    if (!(stiffness > 0.0F)) {
      side = Side();
      return Vector<float>();
    }
    Vector<float> n(static_cast<float>(contact_.normals[3 * i]),
                    static_cast<float>(contact_.normals[3 * i + 1]),
                    static_cast<float>(contact_.normals[3 * i + 2]));
    const float size = length(n);
    if (!(size > 8192.0F)) return Vector<float>();  // a normal that is none
    n = n * (1.0F / size);
    const float height = dot(n, tip);
    const float wished = static_cast<float>(contact_.offsets_um[i]) * 0.001F;
    if (!side.has_offset) {
      // A plane that appears around the tip does not throw it out.
      side.offset = wished < height ? wished : height;
      side.has_offset = true;
    } else {
      // The origin is far from the tip: a normal that turns by a hair moves the offset by
      // millimetres, and the plane at the tip not at all. What it was there is what it rises from.
      side.offset += height - dot(side.normal, tip);
    }
    side.normal = n;
    const float rise = wished - side.offset;
    const float most = kMostRiseMmPerS * step_s_;
    side.offset = rise > most && wished > height ? side.offset + most : wished;
    const float depth = side.offset - height;
    if (!(depth > 0.0F)) {
      side.sticks = false;
      return Vector<float>();
    }
    is_touching_ = true;
    const float damping = static_cast<float>(contact_.damping_mns_per_m[i]) * 1e-6F;  // N s/mm
    float press = stiffness * depth - damping * dot(n, velocity);
    if (!(press > 0.0F)) press = 0.0F;
    Vector<float> force = n * press;
    const float friction = static_cast<float>(contact_.friction[i]) * (1.0F / 128.0F);
    if (friction > 0.0F)
      force = force + stick(side, tip, n, stiffness * kStickShare, friction * press);
    return force;
  }

  Vector<float> stick(Side& side, Vector<float> tip, Vector<float> n, float stiffness, float most) {
    if (!side.sticks) {
      side.anchor = tip;
      side.sticks = true;
    }
    Vector<float> back = side.anchor - tip;
    back = back - n * dot(n, back);
    const float size = length(back) * stiffness;
    if (size > most) {
      back = back * (size > 0.0F ? most / size : 0.0F);
      side.anchor = tip + back;
    }
    return back * stiffness;
  }

  Vector<float> vibration() {
    if (contact_.vibration_mn == 0 || contact_.vibration_hz == 0) return Vector<float>();
    phase_ += static_cast<float>(contact_.vibration_hz) * step_s_;
    if (phase_ >= 1.0F) phase_ -= 1.0F;
    const float wave = sin_cos(6.2831853F * phase_).sin;
    return Vector<float>(0.0F, 0.0F, wave * static_cast<float>(contact_.vibration_mn) * 0.001F);
  }

  float step_s_;
  Contact contact_;
  Side sides_[2];
  Vector<float> tip_;
  Vector<float> force_;  ///< of the planes, that the account has to book
  float stored_ = kFirstStoreNMm;
  float phase_ = 0.0F;
  uint32_t scaled_ = 0;
  bool has_tip_ = false;
  bool is_touching_ = false;
};

}  // namespace firmware
}  // namespace carpus

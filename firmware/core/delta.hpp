// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A delta arm [clavel1988delta]: three equal legs around a base, each an upper arm `a` that a motor
// turns and a pair of rods `b` to a platform that stays level. Leg i stands at phi_i = 0, 120, 240
// degrees; its angle is counted downwards from the horizontal; z is up, the platform below the
// base. With the platform's radius taken off, each rod runs from an elbow e_i to one common point
// p:
//
//   e_i = ((dr + a cos t_i) cos phi_i, (dr + a cos t_i) sin phi_i, -a sin t_i),   |p - e_i| = b
//
// Forward: p is the lower of the two points at distance b from all three elbows. Velocities: with
// s_i = p - e_i and u_i = d e_i/d t_i, s_i . v = (s_i . u_i) t_i', hence v = J t' and, for forces,
// a torque t_i on leg i gives the tip s_i t_i / (s_i . u_i).
#pragma once

#include "firmware/core/real.hpp"

namespace carpus {
namespace firmware {

/// Lengths [mm].
template <typename Real>
struct DeltaSize {
  Real upper_arm = Real(80);
  Real rod = Real(160);
  /// Radius of the base less that of the platform.
  Real offset = Real(45);
};

/// The state of the arm at given angles.
template <typename Real>
struct DeltaState {
  Vector<Real> tip;      ///< [mm]
  Vector<Real> rods[3];  ///< s_i [mm]
  /// s_i . u_i [mm2]: zero where rod and upper arm are in line, where the leg can hold nothing.
  Real levers[3] = {Real(0), Real(0), Real(0)};
  bool is_valid = false;  ///< the rods reach each other, and no leg is near its singularity
};

/// Nearer than this to a straight leg (s.u over a b) is no place to compute forces.
constexpr double kLeastLever = 0.08;
/// Smallest volume of the three rods' directions: below it the rods are nearly in one plane.
constexpr double kLeastVolume = 0.05;

/// The elbow of leg i and d e/d t.
template <typename Real>
void delta_elbow(const DeltaSize<Real>& size,
                 uint8_t leg,
                 Real angle,
                 Vector<Real>& elbow,
                 Vector<Real>& change) {
  constexpr Real kHalfRootThree = Real(0.86602540378443864676);
  const Real cos_phi = leg == 0 ? Real(1) : Real(-0.5);
  const Real sin_phi = leg == 0 ? Real(0) : (leg == 1 ? kHalfRootThree : -kHalfRootThree);
  const SinCos<Real> t = sin_cos(angle);
  const Real out = size.offset + size.upper_arm * t.cos;
  const Real turn = size.upper_arm * t.sin;
  elbow = Vector<Real>(out * cos_phi, out * sin_phi, -turn);
  change = Vector<Real>(-turn * cos_phi, -turn * sin_phi, -size.upper_arm * t.cos);
}

/// @param angles  of the three legs [rad].
template <typename Real>
DeltaState<Real> delta_forward(const DeltaSize<Real>& size, const Real* angles) {
  DeltaState<Real> state;
  Vector<Real> e[3];
  Vector<Real> u[3];
  for (uint8_t i = 0; i < 3; ++i) delta_elbow(size, i, angles[i], e[i], u[i]);
  // The centre of the elbows' circle, and from it down along its axis.
  const Vector<Real> ab = e[1] - e[0];
  const Vector<Real> ac = e[2] - e[0];
  const Vector<Real> n = cross(ab, ac);
  const Real nn = dot(n, n);
  if (!(nn > Real(0))) return state;
  const Vector<Real> to_centre =
      (cross(n, ab) * dot(ac, ac) + cross(ac, n) * dot(ab, ab)) * (Real(1) / (Real(2) * nn));
  const Real below = size.rod * size.rod - dot(to_centre, to_centre);
  if (!(below > Real(0))) return state;
  // ab x ac points up, as the legs go round counter-clockwise.
  state.tip = e[0] + to_centre - n * (root(below) / root(nn));
  const Real least = Real(kLeastLever) * size.upper_arm * size.rod;
  bool is_valid = true;
  for (uint8_t i = 0; i < 3; ++i) {
    state.rods[i] = state.tip - e[i];
    state.levers[i] = dot(state.rods[i], u[i]);
    if (!(state.levers[i] > least)) is_valid = false;
  }
  const Real volume = dot(state.rods[0], cross(state.rods[1], state.rods[2]));
  if (!(absolute(volume) > Real(kLeastVolume) * size.rod * size.rod * size.rod)) is_valid = false;
  state.is_valid = is_valid;
  return state;
}

/// The tip's velocity [mm/s] from the legs' [rad/s]: solves s_i . v = levers_i t_i'.
template <typename Real>
Vector<Real> delta_velocity(const DeltaState<Real>& state, const Real* rates) {
  const Vector<Real>* s = state.rods;
  const Real volume = dot(s[0], cross(s[1], s[2]));
  return (cross(s[1], s[2]) * (state.levers[0] * rates[0]) +
          cross(s[2], s[0]) * (state.levers[1] * rates[1]) +
          cross(s[0], s[1]) * (state.levers[2] * rates[2])) *
         (Real(1) / volume);
}

/// Torques that give the tip a force: tau = J^T F [N mm where F is in N].
template <typename Real>
void delta_torques(const DeltaState<Real>& state, Vector<Real> force, Real* torques) {
  const Vector<Real>* s = state.rods;
  const Real volume = dot(s[0], cross(s[1], s[2]));
  for (uint8_t i = 0; i < 3; ++i) {
    const Vector<Real> column = cross(s[(i + 1) % 3], s[(i + 2) % 3]) * (state.levers[i] / volume);
    torques[i] = dot(column, force);
  }
}

}  // namespace firmware
}  // namespace carpus

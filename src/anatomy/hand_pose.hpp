// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a hand is held on its forearm, and how far it can be taken.
#pragma once

#include <cmath>

namespace carpus::anatomy {

/// Flexion and deviation are the y and z components of the rotation vector of the third metacarpal
/// (and capitate) from neutral, in the Wrist frame of a left wrist; neutral is stated in
/// data/carpal_kinematics.json.
struct HandPose {
  double flexion_rad = 0;           ///< of the hand from neutral; extension is negative
  double radial_deviation_rad = 0;  ///< of the hand from neutral; ulnar deviation is negative
  double pronation_rad = 0;         ///< of the forearm from where it was scanned
  double traction_n = 0;            ///< pull along the hand's long axis
  bool operator==(const HandPose&) const = default;
};

struct Interval {
  double low = 0;
  double high = 0;
  bool operator==(const Interval&) const = default;

  /// The nearest value within; `low` for a NaN.
  [[nodiscard]] constexpr double clamp(double value) const noexcept {
    return value > low ? (value < high ? value : high) : low;
  }
};

/// Range of each input. Flexion and deviation share an envelope: what is left of one shrinks with
/// the other, along a quarter ellipse between the ends of their intervals.
struct HandLimits {
  Interval flexion_rad;
  Interval radial_deviation_rad;
  Interval pronation_rad;
  Interval traction_n;
  bool operator==(const HandLimits&) const = default;

  /// How far flexion and deviation go towards the envelope: 0 in neutral, 1 on it.
  [[nodiscard]] double reach(const HandPose& pose) const noexcept {
    const double f = share(pose.flexion_rad, flexion_rad);
    const double r = share(pose.radial_deviation_rad, radial_deviation_rad);
    return std::sqrt(f * f + r * r);
  }

  /// The pose itself where it is within limits; else each input within its interval, and flexion
  /// and deviation drawn towards neutral until they are within the envelope. Continuous;
  /// real-time.
  [[nodiscard]] HandPose clamp(const HandPose& pose) const noexcept {
    HandPose result{flexion_rad.clamp(pose.flexion_rad),
                    radial_deviation_rad.clamp(pose.radial_deviation_rad),
                    pronation_rad.clamp(pose.pronation_rad), traction_n.clamp(pose.traction_n)};
    const double out = reach(result);
    if (out > 1) {
      result.flexion_rad /= out;
      result.radial_deviation_rad /= out;
    }
    return result;
  }

 private:
  [[nodiscard]] static double share(double value, const Interval& interval) noexcept {
    const double end = value < 0 ? interval.low : interval.high;
    return end != 0 ? value / end : 0;
  }
};

}  // namespace carpus::anatomy

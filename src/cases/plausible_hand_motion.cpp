// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The figures in brackets are the greatest of 20 tables: of both simulated reference CTs and of 18
// wrists of `carpus phantom`.
#include "cases/plausible_hand_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace carpus::cases {
namespace {

using anatomy::CarpalGroup;
using anatomy::Interval;

constexpr double kMostFlexionRad = 2.0;           // [1.4]
constexpr double kMostDeviationRad = 1.2;         // [0.7]
constexpr double kMostPronationRad = 1.570797;    // [1.570796] cos_sin_of_small reaches so far
constexpr double kMostTractionN = 200;            // [100]
constexpr double kMostOpeningMmPerN = 0.1;        // [0.02]
constexpr double kMostTurnRad = 2.6;              // of a group from where it was scanned [1.9]
constexpr double kMostShiftMm = 80;               // of its middle [34]
constexpr double kMostTurnPerRad = 12;            // from node to node [5.6]
constexpr double kMostShiftMmPerRad = 100;        // [38]
constexpr double kMostPronationShiftMm = 10;      // [1.7]
constexpr double kMostPronationShiftPerRad = 20;  // [2.6]
constexpr double kGroupsWithinMm = 150;           // the middles from each other [34]
constexpr double kPronationAxisWithinMm = 150;    // from each middle [46]
constexpr double kUnitTolerance = 1e-3;

bool is_within(const Interval& interval, double most) {
  return interval.low >= -most && interval.high <= most;
}

/// Of the rotation between two unit quaternions [rad].
double turn_between(const GroupMotion& a, const GroupMotion& b) {
  double with = 0;
  for (std::size_t k = 0; k < 4; ++k) with += a.quaternion[k] * b.quaternion[k];
  return 2 * std::acos(std::min(1.0, std::abs(with)));
}

bool spans(const std::vector<double>& axis, const Interval& limits) {
  return axis.front() == limits.low && axis.back() == limits.high;
}

std::optional<std::string> problem_of_frame(const HandMotion& motion) {
  const anatomy::HandLimits& limits = motion.limits;
  if (!is_within(limits.flexion_rad, kMostFlexionRad) ||
      !is_within(limits.radial_deviation_rad, kMostDeviationRad) ||
      !is_within(limits.pronation_rad, kMostPronationRad) || limits.traction_n.low != 0 ||
      limits.traction_n.high > kMostTractionN) {
    return "a limit lies beyond what any wrist can do";
  }
  if (!spans(motion.flexion_rad, limits.flexion_rad) ||
      !spans(motion.deviation_rad, limits.radial_deviation_rad) ||
      !spans(motion.pronation_rad, limits.pronation_rad)) {
    return "an axis does not go from limit to limit";
  }
  if (std::abs(length(motion.hand_axis) - 1) > kUnitTolerance ||
      std::abs(length(motion.pronation_axis) - 1) > kUnitTolerance) {
    return "an axis of motion is not of unit length";
  }
  for (const double opening : {motion.radiocarpal_mm_per_n, motion.midcarpal_mm_per_n}) {
    if (!(opening >= 0 && opening <= kMostOpeningMmPerN)) {
      return "traction opens a joint as no joint opens";
    }
  }
  for (const CarpalGroup a : anatomy::kMovingGroups) {
    const Vec3& middle = motion.reference[static_cast<std::size_t>(a)];
    if (distance(middle, motion.pronation_centre) > kPronationAxisWithinMm) {
      return "the axis of pronation lies beside the wrist";
    }
    for (const CarpalGroup b : anatomy::kMovingGroups) {
      if (distance(middle, motion.reference[static_cast<std::size_t>(b)]) > kGroupsWithinMm) {
        return "bones that move are farther apart than in any wrist";
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> problem_of_scan(const HandMotion& motion) {
  const auto f =
      std::find(motion.flexion_rad.begin(), motion.flexion_rad.end(), motion.scan.flexion_rad);
  const auto r = std::find(motion.deviation_rad.begin(), motion.deviation_rad.end(),
                           motion.scan.radial_deviation_rad);
  if (f == motion.flexion_rad.end() || r == motion.deviation_rad.end()) {
    return "the pose of the scan is none of the table's";
  }
  const auto row = static_cast<std::size_t>(f - motion.flexion_rad.begin());
  const auto column = static_cast<std::size_t>(r - motion.deviation_rad.begin());
  const HandMotionNode& scan = motion.nodes[row * motion.deviation_rad.size() + column];
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    if (!(scan.groups[static_cast<std::size_t>(group)] == GroupMotion{})) {
      return "in the pose of the scan a bone is not where it was scanned";
    }
  }
  return std::nullopt;
}

std::optional<std::string> problem_of_step(const HandMotionNode& from,
                                           const HandMotionNode& to,
                                           double step_rad) {
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    const GroupMotion& a = from.groups[static_cast<std::size_t>(group)];
    const GroupMotion& b = to.groups[static_cast<std::size_t>(group)];
    if (turn_between(a, b) > kMostTurnPerRad * step_rad ||
        distance(a.shift, b.shift) > kMostShiftMmPerRad * step_rad) {
      return "a bone jumps between neighbouring poses";
    }
  }
  return std::nullopt;
}

std::optional<std::string> problem_of_nodes(const HandMotion& motion) {
  const std::vector<double>& flexion = motion.flexion_rad;
  const std::vector<double>& deviation = motion.deviation_rad;
  const std::size_t columns = deviation.size();
  for (std::size_t f = 0; f < flexion.size(); ++f) {
    for (std::size_t r = 0; r < columns; ++r) {
      const HandMotionNode& node = motion.nodes[f * columns + r];
      for (const CarpalGroup group : anatomy::kMovingGroups) {
        const GroupMotion& m = node.groups[static_cast<std::size_t>(group)];
        if (turn_between(m, {}) > kMostTurnRad || length(m.shift) > kMostShiftMm) {
          return "a bone moves farther than in any wrist";
        }
      }
      std::optional<std::string> problem;
      if (f + 1 < flexion.size()) {
        problem =
            problem_of_step(node, motion.nodes[(f + 1) * columns + r], flexion[f + 1] - flexion[f]);
      }
      if (!problem && r + 1 < columns) {
        problem = problem_of_step(node, motion.nodes[f * columns + r + 1],
                                  deviation[r + 1] - deviation[r]);
      }
      if (problem) return problem;
    }
  }
  return std::nullopt;
}

std::optional<std::string> problem_of_pronation(const HandMotion& motion) {
  for (std::size_t i = 0; i < motion.pronation_shift.size(); ++i) {
    if (length(motion.pronation_shift[i]) > kMostPronationShiftMm) {
      return "pronation moves the hand away from the ulna";
    }
    if (i == 0) continue;
    const double step_rad = motion.pronation_rad[i] - motion.pronation_rad[i - 1];
    if (distance(motion.pronation_shift[i], motion.pronation_shift[i - 1]) >
        kMostPronationShiftPerRad * step_rad) {
      return "the hand jumps in pronation";
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> problem_of_motion(const HandMotion& motion) {
  for (const auto& look :
       {&problem_of_frame, &problem_of_scan, &problem_of_nodes, &problem_of_pronation}) {
    if (auto problem = look(motion)) return problem;
  }
  return std::nullopt;
}

}  // namespace carpus::cases

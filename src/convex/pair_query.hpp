// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The contract behind which every method for two bodies stands, the trainer's own and those that
// `survey` compares it with: do two convex bodies meet, how far apart are they, how deep do they
// overlap?
#pragma once

#include <cstdint>
#include <optional>

#include "convex/convex_body.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// Where the second body of a pair lies in the first one's frame. It is taken as given: the second
/// body is { rotation * v + translation }, exactly, even where the matrix is a little off a
/// rotation.
namespace pair_frame {
struct First;
struct Second;
}  // namespace pair_frame
using PairPose = Pose<pair_frame::First, pair_frame::Second>;

/// Bodies are closed: touching is meeting.
enum class Verdict : std::uint8_t {
  Unknown,  ///< the method could not tell (its limits, or a pose that is not finite)
  Apart,
  Meet,
};

/// The nearest points of two bodies that do not meet, in the first one's frame.
struct Closest {
  double distance_mm = 0;
  Vec3 on_first;
  Vec3 on_second;
  Vec3 normal;  ///< unit, from the first to the second
};

/// The shortest translation of the second body that makes two bodies that meet just touch.
struct Penetration {
  double depth_mm = 0;
  Vec3 direction;  ///< unit, in the first one's frame: moving the second by depth_mm along it parts
                   ///< them
  Vec3 on_first;   ///< deepest points, which coincide after that move
  Vec3 on_second;
};

/// One method for one pair of bodies, with what it remembers from query to query. What is
/// remembered changes the cost, never the answer beyond the method's stated tolerance.
/// Real-time: queries are noexcept and allocate nothing after construction.
class PairQuery {
 public:
  PairQuery() = default;
  PairQuery(const PairQuery&) = delete;
  PairQuery& operator=(const PairQuery&) = delete;
  virtual ~PairQuery() = default;

  [[nodiscard]] virtual Verdict meets(const PairPose& first_from_second) noexcept = 0;
  /// Empty where the bodies meet, or where the method does not answer this or could not.
  [[nodiscard]] virtual std::optional<Closest> closest(const PairPose& first_from_second) noexcept;
  /// Empty where the bodies are apart, or where the method does not answer this or could not.
  [[nodiscard]] virtual std::optional<Penetration> penetration(
      const PairPose& first_from_second) noexcept;
  /// Forgets earlier queries: the next one is cold.
  virtual void forget() noexcept = 0;
};

}  // namespace carpus::convex

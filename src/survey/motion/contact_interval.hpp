// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// When do two bodies touch that move straight at constant velocity? Two linear programs in
// (x, y, z, t), the thesis's proximity and penetration programs [yaacoub2008] §5.6, eq. (5.16) to
// (5.23), corrected.
//
// A facet of the first body is a row a . x <= d; one of the second, which moves with the relative
// velocity v, is a . x + e t <= d with e = -a . v (5.17). A point (x, t) of all rows is a common
// point at time t. min t and max t are the first and the last time of contact.
//
// Where the thesis is wrong, and what stands here:
// - (5.19) prints A X >= b against its own (5.17); facets of a closed body leave no such X at all.
// - The dual (5.23) with inequalities holds for X >= 0 only, which forces t >= 0: a negative t, the
//   thesis's penetration, could never be found. x and t are free here.
// - It reads penetration from the sign of the minimum alone; but bodies that have passed each other
//   have a negative minimum too. They touch now iff t_min <= 0 <= t_max.
// - The depth it gives is along the motion, not the least depth; methods.cpp lists what gives that.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "geometry/vec3.hpp"

namespace carpus::survey {

/// Most pivots of one program; for hulls of 500 corners both programs together take about 23 cold
/// and 1 warm, at worst 41.
inline constexpr std::int32_t kMaxMotionPivots = 200;

enum class MotionOutcome : std::uint8_t {
  PivotLimit,  ///< no answer within kMaxMotionPivots
  NotFinite,   ///< pose or velocity holds NaN or infinity
  ScaleRange,  ///< a speed or a translation beyond 1e100, or a speed that is not 0 but below 1e-100
  NeverMeet,   ///< on this course the bodies touch at no time, past or future
  HasPassed,   ///< t_max < 0: they touched and have parted
  Touching,    ///< t_min <= 0 <= t_max
  WillMeet,    ///< t_min > 0
};

/// The first or the last touch.
struct MotionContact {
  Vec3 point;   ///< a common point then, in the first body's frame [mm]
  Vec3 normal;  ///< unit, from the first body to the second, of the planes that touch
};

/// All bodies are closed, and rows count as satisfied up to 1e-11 of the bodies' size and distance
/// (1e-9 mm for a wrist), in favour of contact: a glancing touch is a touch.
struct ContactInterval {
  MotionOutcome outcome = MotionOutcome::PivotLimit;
  double speed_mm_per_s = 0;
  /// Times of the first and the last touch, with HasPassed, Touching and WillMeet [s]; without
  /// relative motion -infinity and infinity, and then `first` and `last` say nothing.
  double t_min_s = 0;
  double t_max_s = 0;
  MotionContact first;
  MotionContact last;
  std::int32_t pivots = 0;

  /// With WillMeet: the way until contact.
  [[nodiscard]] double distance_mm() const noexcept { return speed_mm_per_s * t_min_s; }
  /// With Touching: how long contact has lasted, and the way gone since, which is the penetration
  /// along the motion.
  [[nodiscard]] double touching_since_s() const noexcept { return -t_min_s; }
  [[nodiscard]] double depth_along_motion_mm() const noexcept { return -speed_mm_per_s * t_min_s; }
};

struct MotionStatistics {
  std::uint64_t queries = 0;
  std::uint64_t pivots = 0;
  std::uint64_t warm_programs = 0;  ///< solved from the basis of the last answer
  std::uint64_t pivot_limits = 0;
};

class ContactIntervalQuery {
 public:
  ContactIntervalQuery(const convex::ConvexBody& first, const convex::ConvexBody& second);

  /// @param first_from_second  where the second body is at t = 0.
  /// @param velocity_mm_per_s  of the second against the first, in the first body's frame; any
  ///        number is a speed: a displacement instead gives times in parts of it.
  /// Real-time: no allocation; each pivot looks at every face once; only + - * / sqrt. What is kept
  /// from the last query changes the cost, never the answer beyond the tolerance.
  [[nodiscard]] ContactInterval query(const convex::PairPose& first_from_second,
                                      const Vec3& velocity_mm_per_s) noexcept;

  void forget() noexcept { has_first_ = has_last_ = false; }
  [[nodiscard]] const MotionStatistics& statistics() const noexcept { return statistics_; }

 private:
  friend class MotionProgram;
  /// Rows normal . x + e s <= offset, s = |v| t [mm], as arrays for fast scans: the first body's
  /// faces and box, the second's faces and box in the new pose.
  struct Rows {
    std::vector<double> nx, ny, nz, e, offset;
    void resize(std::size_t count);
    void set(std::size_t row, const Plane& plane, double along) noexcept;
  };

  void place(const convex::PairPose& pose, const Vec3& direction) noexcept;
  [[nodiscard]] ContactInterval still(const ContactInterval& blank) noexcept;

  std::vector<Plane> second_planes_;
  std::vector<Vec3> second_vertices_;
  std::uint32_t first_faces_;
  double first_size_mm_;
  Aabb first_box_;
  Rows rows_;
  double size_mm_ = 0;
  /// Bases of min t and max t.
  std::array<std::uint32_t, 4> first_basis_{};
  std::array<std::uint32_t, 4> last_basis_{};
  bool has_first_ = false;
  bool has_last_ = false;
  MotionStatistics statistics_;
};

}  // namespace carpus::survey

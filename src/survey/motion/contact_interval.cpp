// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// With s = |v| t [mm], so that no speed is too small or too large: min s and max s subject to
// n . x + e s <= d, on the dual by the dual simplex method with four rows, solved afresh at every
// pivot. Multipliers satisfy sum lambda (n, e) = (0, 0, 0, -1) for min and (0, 0, 0, 1) for max:
// equalities, since x and s are free.
// 1. Start: two faces of the bodies' boxes across the main axis of the motion, which bound s, and
//    two others at multiplier 0; or the rows of the last answer, where still dual feasible.
// 2. The row that (x, s) violates most enters. None: the optimum.
// 3. Write it as a combination of the four. No weight positive: the bodies never meet.
// 4. Otherwise the row with the smallest multiplier / weight leaves. After steps without progress,
//    which parallel faces cause, rows are chosen by Bland's rule [bland1977finite].
// Without motion all e are -1: min s is then the least growth at which the bodies touch.
#include "survey/motion/contact_interval.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "geometry/tolerance.hpp"
#include "survey/detail/small_lu.hpp"

namespace carpus::survey {
namespace {

using Basis = detail::SmallLu<4>;
using Indices = std::array<std::uint32_t, 4>;

/// Rows are satisfied up to this part of the bodies' size and distance: kContactToleranceMm for a
/// wrist of 100 mm.
constexpr double kRowTolerance = 1e-11;
/// Multipliers below this are 0: the rounding of a solved basis.
constexpr double kLeastMultiplier = 1e-13;
/// Rows are independent if elimination leaves at least this; normals have length 1.
constexpr double kLeastPivot = 1e-12;
/// Steps without progress before Bland's rule takes over.
constexpr int kPatience = 12;
constexpr std::uint32_t kBoxRows = 6;

bool is_finite_pose(const convex::PairPose& pose) noexcept {
  return is_finite(pose.translation) && is_finite(pose.rotation.rows[0]) &&
         is_finite(pose.rotation.rows[1]) && is_finite(pose.rotation.rows[2]);
}

double largest_magnitude(const Vec3& v) noexcept {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

double largest_magnitude(const Aabb& box) noexcept {
  return std::max(largest_magnitude(box.low), largest_magnitude(box.high));
}

/// Face `index` of a box: 2 axis is the high one, 2 axis + 1 the low one.
Plane box_face(const Aabb& box, std::uint32_t index) noexcept {
  const std::size_t axis = index / 2;
  Plane face;
  face.normal[axis] = index % 2 == 0 ? 1 : -1;
  face.offset = index % 2 == 0 ? box.high[axis] : -box.low[axis];
  return face;
}

enum class Outcome : std::uint8_t { Limit, Infeasible, Optimal };

}  // namespace

/// One program, min or max.
class MotionProgram {
 public:
  using Rows = ContactIntervalQuery::Rows;

  /// @param sense  1 for min s, -1 for max s.
  MotionProgram(const Rows& rows, double sense, double tolerance_mm) noexcept
      : rows_(rows), sense_(sense), tolerance_mm_(tolerance_mm) {}

  /// False where these rows do not bound s.
  bool start(const Indices& indices) noexcept {
    indices_ = indices;
    if (!solve()) return false;
    return std::all_of(multipliers_.begin(), multipliers_.end(), [](double m) { return m >= 0; });
  }

  Outcome run() noexcept {
    int idle = 0;
    while (pivots_ < kMaxMotionPivots) {
      const std::uint32_t entering = idle < kPatience ? most_violated() : first_violated();
      if (entering == kNone) return Outcome::Optimal;
      const Basis::Vector weights = lu_.solve_transposed(row(entering));
      const std::size_t leaving = leaving_position(weights, idle >= kPatience);
      if (leaving == 4) return Outcome::Infeasible;
      const double before = sense_ * s_mm();
      ++pivots_;
      indices_[leaving] = entering;
      if (!solve()) return Outcome::Limit;
      idle = sense_ * s_mm() > before + tolerance_mm_ ? 0 : idle + 1;
    }
    return Outcome::Limit;
  }

  [[nodiscard]] double s_mm() const noexcept { return vertex_[3]; }
  [[nodiscard]] Vec3 point() const noexcept { return {vertex_[0], vertex_[1], vertex_[2]}; }
  [[nodiscard]] const Indices& indices() const noexcept { return indices_; }
  [[nodiscard]] std::int32_t pivots() const noexcept { return pivots_; }

  /// Sum of multiplier * normal over the first body's rows: towards the second body, as long as the
  /// way along the motion is that closes a gap of 1 mm.
  [[nodiscard]] Vec3 force(std::uint32_t first_rows) const noexcept {
    Vec3 sum;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t i = indices_[k];
      if (i < first_rows) sum += Vec3{rows_.nx[i], rows_.ny[i], rows_.nz[i]} * multipliers_[k];
    }
    return sum;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  [[nodiscard]] Basis::Vector row(std::uint32_t i) const noexcept {
    return {rows_.nx[i], rows_.ny[i], rows_.nz[i], rows_.e[i]};
  }
  [[nodiscard]] double violation(std::uint32_t i) const noexcept {
    return rows_.nx[i] * vertex_[0] + rows_.ny[i] * vertex_[1] + rows_.nz[i] * vertex_[2] +
           rows_.e[i] * vertex_[3] - rows_.offset[i];
  }

  bool solve() noexcept {
    lu_ = Basis({row(indices_[0]), row(indices_[1]), row(indices_[2]), row(indices_[3])});
    if (!(lu_.smallest_pivot() > kLeastPivot)) return false;
    vertex_ = lu_.solve({rows_.offset[indices_[0]], rows_.offset[indices_[1]],
                         rows_.offset[indices_[2]], rows_.offset[indices_[3]]});
    multipliers_ = lu_.solve_transposed({0, 0, 0, -sense_});
    for (double& m : multipliers_) m = std::abs(m) < kLeastMultiplier ? 0 : m;
    return true;
  }

  /// Four running maxima, so that comparisons do not wait for each other.
  [[nodiscard]] std::uint32_t most_violated() const noexcept {
    struct Worst {
      std::uint32_t row = kNone;
      double amount = -std::numeric_limits<double>::infinity();
    };
    constexpr std::uint32_t kLanes = 4;
    std::array<Worst, kLanes> worst;
    const auto consider = [&](std::uint32_t i, Worst& lane) {
      const double amount = violation(i);
      const bool is_more = amount > lane.amount;
      lane.row = is_more ? i : lane.row;
      lane.amount = is_more ? amount : lane.amount;
    };
    const auto count = static_cast<std::uint32_t>(rows_.offset.size());
    std::uint32_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) consider(i + lane, worst[lane]);
    }
    for (; i < count; ++i) consider(i, worst[0]);
    const Worst& most =
        *std::max_element(worst.begin(), worst.end(), [](const Worst& a, const Worst& b) {
          return a.amount < b.amount || (a.amount == b.amount && a.row > b.row);
        });
    return most.amount > tolerance_mm_ ? most.row : kNone;
  }

  [[nodiscard]] std::uint32_t first_violated() const noexcept {
    const auto count = static_cast<std::uint32_t>(rows_.offset.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      if (violation(i) > tolerance_mm_) return i;
    }
    return kNone;
  }

  /// The position that leaves, 4 if no weight is positive.
  [[nodiscard]] std::size_t leaving_position(const Basis::Vector& weights,
                                             bool by_index) const noexcept {
    std::size_t best = 4;
    double best_ratio = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(weights[k] > kLeastLpWeight)) continue;
      const double ratio = std::max(multipliers_[k], 0.0) / weights[k];
      const bool wins_tie = best != 4 && ratio == best_ratio &&
                            (by_index ? indices_[k] < indices_[best] : weights[k] > weights[best]);
      if (ratio < best_ratio || wins_tie) {
        best = k;
        best_ratio = ratio;
      }
    }
    return best;
  }

  const Rows& rows_;
  double sense_;
  double tolerance_mm_;
  Indices indices_{};
  Basis lu_{Basis::Matrix{}};
  Basis::Vector vertex_{};
  Basis::Vector multipliers_{};
  std::int32_t pivots_ = 0;
};

namespace {

/// Faces of the boxes that bound s from below (sense 1) or above (-1) along `direction`.
Indices box_basis(const Vec3& direction,
                  double sense,
                  std::uint32_t first_box,
                  std::uint32_t second_box) noexcept {
  std::uint32_t axis = 0;
  for (std::uint32_t i = 1; i < 3; ++i) {
    if (std::abs(direction[i]) > std::abs(direction[axis])) axis = i;
  }
  // The second body's face ahead meets the first's on its other side.
  const bool ahead_is_high = direction[axis] * sense >= 0;
  return {second_box + 2 * axis + (ahead_is_high ? 0U : 1U),
          first_box + 2 * axis + (ahead_is_high ? 1U : 0U), first_box + 2 * ((axis + 1) % 3),
          first_box + 2 * ((axis + 2) % 3)};
}

/// Warm where that is possible, else cold. Keeps the basis of an optimum.
Outcome solve_program(MotionProgram& program,
                      const Indices& cold,
                      Indices& kept,
                      bool& has_kept,
                      MotionStatistics& statistics) noexcept {
  Outcome outcome = Outcome::Limit;
  if (has_kept && program.start(kept)) {
    outcome = program.run();
    statistics.warm_programs += outcome != Outcome::Limit ? 1U : 0U;
  }
  if (outcome == Outcome::Limit && program.start(cold)) outcome = program.run();
  has_kept = outcome == Outcome::Optimal;
  if (has_kept) kept = program.indices();
  statistics.pivots += static_cast<std::uint64_t>(program.pivots());
  return outcome;
}

}  // namespace

void ContactIntervalQuery::Rows::resize(std::size_t count) {
  for (std::vector<double>* column : {&nx, &ny, &nz, &e, &offset}) column->resize(count);
}

void ContactIntervalQuery::Rows::set(std::size_t row, const Plane& plane, double along) noexcept {
  nx[row] = plane.normal.x;
  ny[row] = plane.normal.y;
  nz[row] = plane.normal.z;
  e[row] = along;
  offset[row] = plane.offset;
}

ContactIntervalQuery::ContactIntervalQuery(const convex::ConvexBody& first,
                                           const convex::ConvexBody& second)
    : second_vertices_(second.vertices().begin(), second.vertices().end()),
      first_faces_(static_cast<std::uint32_t>(first.faces().size())),
      first_size_mm_(largest_magnitude(first.box())),
      first_box_(first.box()) {
  const auto second_faces = static_cast<std::uint32_t>(second.faces().size());
  for (std::uint32_t i = 0; i < second_faces; ++i) second_planes_.push_back(second.face_plane(i));
  rows_.resize(first_faces_ + second_faces + 2 * std::size_t{kBoxRows});
  for (std::uint32_t i = 0; i < first_faces_; ++i) rows_.set(i, first.face_plane(i), 0);
  for (std::uint32_t i = 0; i < kBoxRows; ++i) {
    rows_.set(first_faces_ + i, box_face(first_box_, i), 0);
  }
}

/// @param direction  unit, or 0 for growth.
void ContactIntervalQuery::place(const convex::PairPose& pose, const Vec3& direction) noexcept {
  const bool is_still = direction == Vec3{};
  const std::uint32_t first_rows = first_faces_ + kBoxRows;
  for (std::uint32_t i = 0; i < first_rows; ++i) rows_.e[i] = is_still ? -1 : 0;
  const auto set = [&](std::size_t row, const Plane& plane) {
    rows_.set(row, plane, is_still ? -1 : -dot(plane.normal, direction));
  };
  Aabb box;
  for (const Vec3& v : second_vertices_) box.include(pose.rotation * v + pose.translation);
  for (std::size_t i = 0; i < second_planes_.size(); ++i) {
    const Vec3 normal = pose.rotation * second_planes_[i].normal;
    set(first_rows + i, {normal, second_planes_[i].offset + dot(normal, pose.translation)});
  }
  for (std::uint32_t i = 0; i < kBoxRows; ++i) {
    set(first_rows + second_planes_.size() + i, box_face(box, i));
  }
  size_mm_ = std::max(first_size_mm_, largest_magnitude(box));
}

ContactInterval ContactIntervalQuery::still(const ContactInterval& blank) noexcept {
  ContactInterval result = blank;
  const double tolerance_mm = kRowTolerance * size_mm_;
  const std::uint32_t first_rows = first_faces_ + kBoxRows;
  const auto second_box = static_cast<std::uint32_t>(rows_.offset.size()) - kBoxRows;
  MotionProgram program(rows_, 1, tolerance_mm);
  bool has_kept = false;
  const Outcome outcome =
      solve_program(program, box_basis({}, 1, first_rows - kBoxRows, second_box), first_basis_,
                    has_kept, statistics_);
  forget();
  result.pivots = program.pivots();
  if (outcome == Outcome::Limit) {
    ++statistics_.pivot_limits;
    return result;
  }
  const bool touches = outcome == Outcome::Optimal && program.s_mm() <= tolerance_mm;
  result.outcome = touches ? MotionOutcome::Touching : MotionOutcome::NeverMeet;
  if (touches) {
    result.t_min_s = -std::numeric_limits<double>::infinity();
    result.t_max_s = std::numeric_limits<double>::infinity();
  }
  return result;
}

ContactInterval ContactIntervalQuery::query(const convex::PairPose& first_from_second,
                                            const Vec3& velocity_mm_per_s) noexcept {
  ++statistics_.queries;
  ContactInterval result;
  if (!is_finite_pose(first_from_second) || !is_finite(velocity_mm_per_s)) {
    result.outcome = MotionOutcome::NotFinite;
    return result;
  }
  const double largest = largest_magnitude(velocity_mm_per_s);
  if (largest > kLargestCoordinate || (largest > 0 && largest < kSmallestCoordinate) ||
      largest_magnitude(first_from_second.translation) > kLargestCoordinate) {
    result.outcome = MotionOutcome::ScaleRange;
    return result;
  }
  if (largest == 0) {
    place(first_from_second, {});
    return still(result);
  }
  const Vec3 scaled = velocity_mm_per_s / largest;
  result.speed_mm_per_s = largest * length(scaled);
  const Vec3 direction = scaled / length(scaled);
  place(first_from_second, direction);

  const double tolerance_mm = kRowTolerance * size_mm_;
  const std::uint32_t first_rows = first_faces_ + kBoxRows;
  const auto second_box = static_cast<std::uint32_t>(rows_.offset.size()) - kBoxRows;
  const auto cold = [&](double sense) {
    return box_basis(direction, sense, first_rows - kBoxRows, second_box);
  };
  MotionProgram least(rows_, 1, tolerance_mm);
  const Outcome of_least = solve_program(least, cold(1), first_basis_, has_first_, statistics_);
  MotionProgram most(rows_, -1, tolerance_mm);
  const Outcome of_most = of_least == Outcome::Optimal
                              ? solve_program(most, cold(-1), last_basis_, has_last_, statistics_)
                              : of_least;
  result.pivots = least.pivots() + most.pivots();
  if (of_least == Outcome::Limit || of_most == Outcome::Limit) {
    ++statistics_.pivot_limits;
    return result;
  }
  if (of_least == Outcome::Infeasible) {
    result.outcome = MotionOutcome::NeverMeet;
    return result;
  }
  // A glancing touch that only one of the two programs allows is one moment.
  const MotionProgram& end =
      of_most == Outcome::Optimal && most.s_mm() > least.s_mm() ? most : least;
  const Vec3 first_force = least.force(first_rows);
  const Vec3 last_force = end.force(first_rows);
  result.t_min_s = least.s_mm() / result.speed_mm_per_s;
  result.t_max_s = end.s_mm() / result.speed_mm_per_s;
  result.first = {least.point(), normalized_or(first_force, direction)};
  result.last = {end.point(), normalized_or(last_force, direction)};
  // Times within what the tolerance is worth on this course count as now.
  if (least.s_mm() > tolerance_mm * length(first_force)) {
    result.outcome = MotionOutcome::WillMeet;
  } else if (end.s_mm() < -tolerance_mm * length(last_force)) {
    result.outcome = MotionOutcome::HasPassed;
  } else {
    result.outcome = MotionOutcome::Touching;
  }
  return result;
}

}  // namespace carpus::survey

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// min mu phi (5.11) subject to A gamma = b, gamma >= 0 (5.12 to 5.15). With the column u / mu its
// variable is mu phi itself, in mm, at cost 1, and all other costs are 0:
// 1. Start: one vertex of each body and u / mu, and two vertices at weight 0 that make the five
//    columns independent; or the columns of the last answer, whose weights, in the new pose, give
//    the new u.
// 2. y = (pi, sigma_1, sigma_2) solves B'y = c. Column v_i improves where pi . v_i + sigma_1 > 0,
//    column w_i where -pi . w_i + sigma_2 > 0: an extreme vertex of each body along pi.
// 3. None: the optimum. Else the column enters and the one whose weight reaches 0 first leaves; if
//    that is u's, the bodies have a common point.
#include "survey/ivri/ivri_cd.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "survey/detail/small_lu.hpp"

namespace carpus::survey {
namespace {

using Basis = detail::SmallLu<5>;

/// A step of a weight below this against the entering weight is rounding.
constexpr double kLeastStep = 1e-11;
/// Weights below this are 0: the rounding of a solved basis.
constexpr double kLeastWeight = 1e-13;
/// A vertex improves if it lies beyond the current supporting plane by more than this part of the
/// bodies' size; a plane's rounding is a hundred times less.
constexpr double kPricingTolerance = 1e-13;
/// Columns are independent if elimination leaves at least this part of the bodies' size.
constexpr double kLeastPivot = 1e-13;
/// Steps without progress before Bland's rule takes over.
constexpr int kPatience = 20;
/// Cold starts of one query, each along another u.
constexpr std::size_t kStarts = 4;

double largest_magnitude(const Vec3& v) noexcept {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

struct Extreme {
  std::uint32_t index = 0;
  double value = -std::numeric_limits<double>::infinity();
};

/// The vertex farthest along `d`. Four running maxima, so that comparisons do not wait.
template <typename Points>
Extreme farthest(const Points& points, const Vec3& d) noexcept {
  constexpr std::uint32_t kLanes = 4;
  std::array<Extreme, kLanes> best;
  const double* x = points.x.data();
  const double* y = points.y.data();
  const double* z = points.z.data();
  const auto consider = [&](std::uint32_t i, Extreme& lane) {
    const double value = d.x * x[i] + d.y * y[i] + d.z * z[i];
    const bool is_more = value > lane.value;
    lane.index = is_more ? i : lane.index;
    lane.value = is_more ? value : lane.value;
  };
  const std::uint32_t count = points.size();
  std::uint32_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) consider(i + lane, best[lane]);
  }
  for (; i < count; ++i) consider(i, best[0]);
  return *std::max_element(best.begin(), best.end(), [](const Extreme& a, const Extreme& b) {
    return a.value < b.value || (a.value == b.value && a.index > b.index);
  });
}

bool is_finite_pose(const convex::PairPose& pose) noexcept {
  return is_finite(pose.translation) && is_finite(pose.rotation.rows[0]) &&
         is_finite(pose.rotation.rows[1]) && is_finite(pose.rotation.rows[2]);
}

}  // namespace

IvriCd::Points::Points(std::span<const Vec3> points) {
  if (points.size() < 4) {
    throw InvalidInput("IVRI-CD: a body has " + std::to_string(points.size()) +
                       " vertices; four are needed");
  }
  for (const Vec3& p : points) {
    if (!is_finite(p)) throw InvalidInput("IVRI-CD: a vertex is not finite");
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
    mean += p / static_cast<double>(points.size());
  }
}

/// One query.
class IvriCd::Simplex {
 public:
  Simplex(IvriCd& owner, const convex::PairPose& pose) noexcept
      : first_(owner.first_),
        second_(owner.second_),
        pose_(pose),
        back_(pose.rotation.transposed()),
        u_column_(first_.size() + second_.size()),
        epsilon_mm_(owner.epsilon_mm_),
        statistics_(owner.statistics_) {}

  /// False where the kept columns do not stand in the new pose.
  bool start_warm(const std::array<std::uint32_t, 5>& basis,
                  const std::array<double, 5>& values) noexcept {
    columns_ = basis;
    const auto at_u = std::find(columns_.begin(), columns_.end(), u_column_);
    if (at_u != columns_.end()) {
      Vec3 p;
      Vec3 q;
      for (std::size_t k = 0; k < 5; ++k) {
        if (columns_[k] < first_.size()) p += vertex(columns_[k]) * values[k];
        if (columns_[k] >= first_.size() && columns_[k] != u_column_) {
          q += vertex(columns_[k]) * values[k];
        }
      }
      set_line(q - p);
    }
    if (!solve()) return false;
    return std::all_of(weights_.begin(), weights_.end(), [](double w) { return w >= 0; });
  }

  /// False where all vertices lie in one plane.
  /// @param attempt  0: towards the other body; later ones, after a basis became singular,
  /// elsewhere
  bool start_cold(std::size_t attempt) noexcept {
    Vec3 towards = pose_.rotation * second_.mean + pose_.translation - first_.mean;
    if (attempt > 0)
      towards = {towards[attempt % 3], towards[(attempt + 1) % 3], -towards[(attempt + 2) % 3]};
    const std::uint32_t a = farthest(first_, towards).index;
    const std::uint32_t b = first_.size() + farthest(second_, -(back_ * towards)).index;
    set_line(vertex(b) - vertex(a));
    columns_ = {a, b, u_column_, a, b};
    // Two more columns that widen the basis: out of u's line, then out of the plane.
    Vec3 across = any_perpendicular(normalized_or(line_, {1, 0, 0}));
    columns_[3] = widest(across, a, b);
    across = cross(line_, offset(columns_[3], a, b));
    columns_[4] = widest(across, a, b);
    return solve();
  }

  IvriAnswer run() noexcept {
    int idle = 0;
    while (true) {
      if (residual_mm() <= epsilon_mm_) return answer(IvriStatus::Meet);
      const Basis::Vector y = lu().solve_transposed(costs());
      const std::uint32_t entering = idle < kPatience ? steepest(y) : smallest(y);
      if (entering == u_column_) return answer(IvriStatus::Apart);
      if (pivots_ >= kMaxIvriPivots) return answer(IvriStatus::PivotLimit);
      const Basis::Vector step = lu().solve(column(entering));
      const std::size_t leaving = leaving_position(step, idle >= kPatience);
      if (leaving == 5) return answer(IvriStatus::PivotLimit);
      ++pivots_;
      statistics_.bland_pivots += idle >= kPatience ? 1U : 0U;
      const double before = residual_mm();
      columns_[leaving] = entering;
      if (!solve()) return answer(IvriStatus::PivotLimit);
      idle = residual_mm() < before - kPricingTolerance * size_mm_ ? 0 : idle + 1;
    }
  }

  [[nodiscard]] const std::array<std::uint32_t, 5>& columns() const noexcept { return columns_; }
  [[nodiscard]] const std::array<double, 5>& weights() const noexcept { return weights_; }

 private:
  /// In the first body's frame, of the columns of either body.
  [[nodiscard]] Vec3 vertex(std::uint32_t c) const noexcept {
    return c < first_.size() ? first_[c]
                             : pose_.rotation * second_[c - first_.size()] + pose_.translation;
  }
  [[nodiscard]] Vec3 offset(std::uint32_t c, std::uint32_t a, std::uint32_t b) const noexcept {
    return vertex(c) - vertex(c < first_.size() ? a : b);
  }
  [[nodiscard]] Basis::Vector column(std::uint32_t c) const noexcept {
    if (c == u_column_) return {line_.x, line_.y, line_.z, 0, 0};
    const Vec3 v = vertex(c);
    if (c < first_.size()) return {v.x, v.y, v.z, 1, 0};
    return {-v.x, -v.y, -v.z, 0, 1};
  }
  [[nodiscard]] Basis::Vector costs() const noexcept {
    Basis::Vector c{};
    for (std::size_t k = 0; k < 5; ++k) c[k] = columns_[k] == u_column_ ? 1 : 0;
    return c;
  }
  [[nodiscard]] const Basis& lu() const noexcept { return lu_; }

  void set_line(const Vec3& u) noexcept {
    const double mu = largest_magnitude(u);
    line_ = mu > 0 ? u / mu : Vec3{1, 0, 0};
  }

  /// The vertex farthest along `d`, either way, from its body's start vertex.
  [[nodiscard]] std::uint32_t widest(const Vec3& d,
                                     std::uint32_t a,
                                     std::uint32_t b) const noexcept {
    const Vec3 in_second = back_ * d;
    const std::array<std::uint32_t, 4> candidates{
        farthest(first_, d).index, farthest(first_, -d).index,
        first_.size() + farthest(second_, in_second).index,
        first_.size() + farthest(second_, -in_second).index};
    return *std::max_element(
        candidates.begin(), candidates.end(), [&](std::uint32_t c, std::uint32_t e) {
          return std::abs(dot(d, offset(c, a, b))) < std::abs(dot(d, offset(e, a, b)));
        });
  }

  /// Weights of the columns; false if they are not independent.
  bool solve() noexcept {
    Basis::Matrix matrix{};
    size_mm_ = 0;
    for (std::size_t k = 0; k < 5; ++k) {
      const Basis::Vector c = column(columns_[k]);
      for (std::size_t i = 0; i < 5; ++i) {
        matrix[i][k] = c[i];
        if (i < 3 && columns_[k] != u_column_) size_mm_ = std::max(size_mm_, std::abs(c[i]));
      }
    }
    lu_ = Basis(matrix);
    if (!(lu_.smallest_pivot() > kLeastPivot * std::min(size_mm_, 1.0))) return false;
    weights_ = lu_.solve({0, 0, 0, 1, 1});
    for (double& w : weights_) w = std::abs(w) < kLeastWeight ? 0 : w;
    return true;
  }

  [[nodiscard]] double residual_mm() const noexcept {
    for (std::size_t k = 0; k < 5; ++k) {
      if (columns_[k] == u_column_) return weights_[k];
    }
    return 0;
  }

  [[nodiscard]] double tolerance(const Basis::Vector& y) const noexcept {
    return kPricingTolerance * size_mm_ * (1 + std::abs(y[0]) + std::abs(y[1]) + std::abs(y[2]));
  }

  /// The column that improves most, or u's for none.
  [[nodiscard]] std::uint32_t steepest(const Basis::Vector& y) const noexcept {
    const Vec3 pi{y[0], y[1], y[2]};
    const Extreme v = farthest(first_, pi);
    const Extreme w = farthest(second_, -(back_ * pi));
    const double of_v = v.value + y[3];
    const double of_w = w.value - dot(pi, pose_.translation) + y[4];
    if (!(std::max(of_v, of_w) > tolerance(y))) return u_column_;
    return of_v >= of_w ? v.index : first_.size() + w.index;
  }

  /// The first column that improves at all, or u's for none.
  [[nodiscard]] std::uint32_t smallest(const Basis::Vector& y) const noexcept {
    const Vec3 pi{y[0], y[1], y[2]};
    for (std::uint32_t c = 0; c < u_column_; ++c) {
      const double price =
          c < first_.size() ? dot(pi, vertex(c)) + y[3] : -dot(pi, vertex(c)) + y[4];
      if (price > tolerance(y)) return c;
    }
    return u_column_;
  }

  /// The position whose weight reaches 0 first, u's before others; 5 for none.
  [[nodiscard]] std::size_t leaving_position(const Basis::Vector& step,
                                             bool by_index) const noexcept {
    std::size_t best = 5;
    double best_ratio = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 5; ++k) {
      if (!(step[k] > kLeastStep)) continue;
      const double ratio = std::max(weights_[k], 0.0) / step[k];
      const bool wins_tie = best != 5 && ratio == best_ratio && columns_[best] != u_column_ &&
                            (columns_[k] == u_column_ ||
                             (by_index ? columns_[k] < columns_[best] : step[k] > step[best]));
      if (ratio < best_ratio || wins_tie) {
        best = k;
        best_ratio = ratio;
      }
    }
    return best;
  }

  [[nodiscard]] IvriAnswer answer(IvriStatus status) const noexcept {
    IvriAnswer result;
    result.status = status;
    result.pivots = pivots_;
    result.residual_mm = residual_mm();
    for (std::size_t k = 0; k < 5; ++k) {
      if (columns_[k] == u_column_) continue;
      (columns_[k] < first_.size() ? result.on_first : result.on_second) +=
          vertex(columns_[k]) * weights_[k];
    }
    return result;
  }

  const Points& first_;
  const Points& second_;
  const convex::PairPose& pose_;
  Mat3 back_;
  std::uint32_t u_column_;
  double epsilon_mm_;
  IvriStatistics& statistics_;
  Vec3 line_;  ///< u / mu
  std::array<std::uint32_t, 5> columns_{};
  Basis::Vector weights_{};
  Basis lu_{Basis::Matrix{}};
  double size_mm_ = 0;  ///< largest coordinate of the basis
  std::int32_t pivots_ = 0;
};

IvriCd::IvriCd(std::span<const Vec3> first, std::span<const Vec3> second, double epsilon_mm)
    : first_(first), second_(second), epsilon_mm_(epsilon_mm) {}

IvriAnswer IvriCd::query(const convex::PairPose& first_from_second) noexcept {
  ++statistics_.queries;
  IvriAnswer answer;
  if (!is_finite_pose(first_from_second)) {
    answer.status = IvriStatus::NotFinite;
    return answer;
  }
  Simplex simplex(*this, first_from_second);
  std::int32_t pivots = 0;
  if (has_basis_ && simplex.start_warm(basis_, values_)) {
    ++statistics_.warm_starts;
    answer = simplex.run();
    pivots = answer.pivots;
  }
  for (std::size_t attempt = 0; attempt < kStarts; ++attempt) {
    if (answer.status != IvriStatus::PivotLimit || pivots >= kMaxIvriPivots) break;
    if (!simplex.start_cold(attempt)) continue;
    answer = simplex.run();
    pivots = answer.pivots;
  }
  statistics_.pivots += static_cast<std::uint64_t>(pivots);
  has_basis_ = answer.status != IvriStatus::PivotLimit;
  if (!has_basis_) ++statistics_.pivot_limits;
  basis_ = simplex.columns();
  values_ = simplex.weights();
  return answer;
}

}  // namespace carpus::survey

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/detail/naming_search.hpp"

#include <algorithm>
#include <cmath>

#include "anatomy/assignment.hpp"
#include "anatomy/symmetric_eigen.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace carpus::anatomy::detail {
namespace {

/// Scales of the terms of the cost: about two standard deviations of what differs between people
/// and postures.
constexpr double kPlaceScaleMm = 5.0;
constexpr double kMaxPlaceCost = 12.0;
constexpr double kVolumeScale = 0.35;  // of the logarithm
constexpr double kExtentScale = 0.2;   // of the logarithm
constexpr double kCutMismatchCost = 6.0;
/// A bone that is not there, and a body that is no bone, cost as much as a bone in a wrong place.
constexpr double kMissingCost = 12.0;
constexpr double kNamelessCost = 12.0;
/// Beyond it, leaving the bone out and the body nameless is the better account.
constexpr double kWorstPair = kMissingCost + kNamelessCost;
/// Wrists against a model of 25.5 mm scaphoid length: 18 to 36 mm, wider than adults are.
constexpr ScaleRange kScaleRange{0.7, 1.4};
constexpr int kRounds = 12;
constexpr int kRolls = 8;
constexpr double kNearbyRad = 20.0 * kPi / 180.0;

/// What a bone and a body have in common but for place: logarithms are taken once.
struct LogShape {
  double volume = 0;
  std::array<double, 3> extents{};
  bool is_cut = false;
};

LogShape log_shape_of(const BodyShape& shape) {
  constexpr double kLeast = 1e-6;  // keeps the logarithm of an empty or flat body finite
  LogShape result;
  result.volume = std::log(std::max(shape.volume_mm3, kLeast));
  for (std::size_t k = 0; k < 3; ++k) {
    result.extents[k] = std::log(std::max(shape.extents[k], kLeast));
  }
  result.is_cut = shape.is_cut;
  return result;
}

double square(double x) { return x * x; }

double shape_cost(const LogShape& body, const LogShape& bone, double log_scale) {
  double extents = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    extents += square((body.extents[k] - bone.extents[k] - log_scale) / kExtentScale) / 3;
  }
  const double volume = square((body.volume - bone.volume - 3 * log_scale) / kVolumeScale);
  return 0.5 * volume + extents + (body.is_cut != bone.is_cut ? kCutMismatchCost : 0.0);
}

/// The bodies against the model of one side.
class Search {
 public:
  Search(std::span<const BodyShape> bodies, Side side)
      : side_(side), postures_(places_in_postures(generic_model_shapes(side), side)) {
    for (const BodyShape& body : bodies) {
      places_.push_back(body.centroid);
      body_logs_.push_back(log_shape_of(body));
    }
    const ModelShapes& model = generic_model_shapes(side);
    for (std::size_t b = 0; b < kBoneCount; ++b) bone_logs_[b] = log_shape_of(model[b]);
  }

  [[nodiscard]] std::size_t posture_count() const { return postures_.size(); }

  /// Improves from one orientation in one posture until names stop changing.
  [[nodiscard]] Naming improve(std::size_t posture, const Mat3& rotation) const {
    const BonePlaces& model = postures_[posture];
    Naming naming;
    naming.side = side_;
    naming.patient_from_model = {rotation, 1.0, mean_of(places_) - rotation * mean_of(model)};
    for (int round = 0; round < kRounds; ++round) {
      const auto before = naming.body_of_bone;
      assign(model, naming);
      if (round > 0 && before == naming.body_of_bone) break;
      refit(model, naming);
    }
    assign(model, naming);
    return naming;
  }

  /// Orientations that lay the model's main axis on that of the bodies, both ways, in all rolls.
  [[nodiscard]] std::vector<Mat3> start_rotations(std::size_t posture) const {
    const Mat3 bodies = principal_frame(places_);
    const Mat3 model = principal_frame(postures_[posture]);
    std::vector<Mat3> starts;
    for (int flip = 0; flip < 2; ++flip) {
      const Mat3 turn = rotation_about({0, 0, 1}, flip * kPi);
      for (int roll = 0; roll < kRolls; ++roll) {
        const Mat3 spin = rotation_about({1, 0, 0}, 2 * kPi * roll / kRolls);
        starts.push_back(bodies * spin * turn * model.transposed());
      }
    }
    return starts;
  }

 private:
  static Vec3 mean_of(std::span<const Vec3> points) {
    Vec3 sum;
    for (const Vec3& p : points) sum += p;
    return points.empty() ? sum : sum / static_cast<double>(points.size());
  }

  /// Right-handed frame along the principal axes, the longest first.
  static Mat3 principal_frame(std::span<const Vec3> points) {
    BodyShape cloud;
    SquareMatrix<3> m{};
    const Vec3 centre = mean_of(points);
    for (const Vec3& p : points) {
      const Vec3 d = p - centre;
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = r; c < 3; ++c) m[r][c] += d[r] * d[c];
      }
    }
    const auto e = eigen_of_symmetric<3>(m);
    const Vec3 a{e.vectors[0][0], e.vectors[0][1], e.vectors[0][2]};
    const Vec3 b{e.vectors[1][0], e.vectors[1][1], e.vectors[1][2]};
    return Mat3::from_columns(a, b, cross(a, b));
  }

  void assign(const BonePlaces& model, Naming& naming) const {
    const std::size_t n = places_.size();
    const std::size_t size = std::max(n, kBoneCount);
    const double log_scale = std::log(naming.patient_from_model.scale);
    std::vector<double> costs(size * size, kMissingCost);
    for (std::size_t b = 0; b < kBoneCount; ++b) {
      const Vec3 expected = naming.patient_from_model * model[b];
      for (std::size_t i = 0; i < n; ++i) {
        const double place =
            std::min(squared_length(places_[i] - expected) / square(kPlaceScaleMm), kMaxPlaceCost);
        costs[b * size + i] =
            std::min(place + shape_cost(body_logs_[i], bone_logs_[b], log_scale), kWorstPair);
      }
    }
    const auto column = assign_at_least_cost(costs, size, size);
    naming.cost = 0;
    std::size_t named = 0;
    for (std::size_t b = 0; b < kBoneCount; ++b) {
      const double cost = costs[b * size + column[b]];
      const bool is_body = column[b] < n && cost < kWorstPair;
      naming.body_of_bone[b] = is_body ? std::optional(column[b]) : std::nullopt;
      naming.bone_cost[b] = is_body ? cost : kMissingCost;
      naming.cost += naming.bone_cost[b];
      named += is_body ? 1 : 0;
    }
    naming.cost += kNamelessCost * static_cast<double>(n - named);
  }

  void refit(const BonePlaces& model, Naming& naming) const {
    std::vector<Vec3> from, to;
    std::vector<double> weights;
    for (std::size_t b = 0; b < kBoneCount; ++b) {
      const std::optional<std::size_t>& body = naming.body_of_bone[b];
      if (!body) continue;
      from.push_back(model[b]);
      to.push_back(places_[*body]);
      weights.push_back(1 / (1 + naming.bone_cost[b]));
    }
    if (from.size() < 3) return;
    naming.patient_from_model = fit_similarity(from, to, weights, kScaleRange);
  }

  Side side_;
  std::vector<BonePlaces> postures_;
  std::vector<Vec3> places_;
  std::vector<LogShape> body_logs_;
  std::array<LogShape, kBoneCount> bone_logs_;
};

/// Best over starts that are tried side by side; the first of equals.
template <typename RotationsOf>
Naming best_of_starts(const Search& search, const RotationsOf& rotations_of) {
  std::vector<Naming> best(search.posture_count());
  parallel_for(best.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t posture = begin; posture < end; ++posture) {
      bool first = true;
      for (const Mat3& rotation : rotations_of(posture)) {
        const Naming naming = search.improve(posture, rotation);
        if (first || naming.cost < best[posture].cost) best[posture] = naming;
        first = false;
      }
    }
  });
  return *std::min_element(best.begin(), best.end(),
                           [](const Naming& a, const Naming& b) { return a.cost < b.cost; });
}

}  // namespace

Naming best_naming(std::span<const BodyShape> bodies, Side side) {
  const Search search(bodies, side);
  return best_of_starts(search, [&](std::size_t p) { return search.start_rotations(p); });
}

Naming best_naming_near(std::span<const BodyShape> bodies, const Naming& known) {
  const Search search(bodies, known.side);
  std::vector<Mat3> rotations{known.patient_from_model.rotation};
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    for (const double angle : {-kNearbyRad, kNearbyRad}) {
      rotations.push_back(known.patient_from_model.rotation * rotation_about(axis, angle));
    }
  }
  return best_of_starts(search, [&](std::size_t) { return rotations; });
}

}  // namespace carpus::anatomy::detail

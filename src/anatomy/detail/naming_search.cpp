// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/detail/naming_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

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
/// A joint end as long as this shows its shape.
constexpr double kTrustedLengthMm = 12.0;
/// A bone that is not there costs as much as a bone in a wrong place.
constexpr double kMissingCost = 12.0;
/// Beyond it, leaving the bone out and the body nameless is the better account.
constexpr double kWorstPair = kMissingCost + kNamelessCost;
/// Wrists against a model of 25.5 mm scaphoid length: 18 to 36 mm, wider than adults are.
constexpr ScaleRange kScaleRange{0.7, 1.4};
constexpr int kRounds = 12;
constexpr int kRolls = 8;
constexpr double kNearbyRad = 20.0 * kPi / 180.0;

/// What a bone and a body have in common but for place: logarithms are taken once.
EndMeasure logs_of(const BodyShape& shape) {
  constexpr double kLeast = 1e-6;  // keeps the logarithm of an empty or flat body finite
  EndMeasure result;
  result.log_volume = std::log(std::max(shape.volume_mm3, kLeast));
  for (std::size_t k = 0; k < 3; ++k) {
    result.log_extents[k] = std::log(std::max(shape.extents[k], kLeast));
  }
  result.centroid = shape.centroid;
  return result;
}

double square(double x) { return x * x; }

double shape_cost(const EndMeasure& body, const EndMeasure& bone, double log_scale) {
  double extents = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    extents += square((body.log_extents[k] - bone.log_extents[k] - log_scale) / kExtentScale) / 3;
  }
  const double volume = square((body.log_volume - bone.log_volume - 3 * log_scale) / kVolumeScale);
  return 0.5 * volume + extents;
}

/// A body taken for a bone.
struct Match {
  double cost = 0;
  Vec3 bone_place;  ///< model, before the similarity
  Vec3 body_place;
};

/// The bodies against the model of one side.
class Search {
 public:
  Search(std::span<const BodyShape> bodies, Side side)
      : side_(side),
        bones_(&generic_model_shapes(side)),
        postures_(all_postures(*bones_, side)),
        bodies_(bodies) {
    for (const BodyShape& body : bodies) {
      places_.push_back(body.centroid);
      body_logs_.push_back(logs_of(body));
    }
    for (std::size_t b = 0; b < kBoneCount; ++b) bone_logs_[b] = logs_of((*bones_)[b]);
    for (const Posture& posture : postures_) {
      std::vector<Vec3> places;
      for (std::size_t b = 0; b < kBoneCount; ++b) {
        places.push_back(posture.place(kAllBones[b], (*bones_)[b].centroid));
      }
      posture_places_.push_back(std::move(places));
    }
  }

  [[nodiscard]] std::size_t posture_count() const { return postures_.size(); }

  /// Improves from one orientation in one posture until names stop changing. `from_crowd` lays the
  /// places where bones are closest upon each other instead of the means of all: fingers in the
  /// scan draw the mean away from the wrist.
  [[nodiscard]] Naming improve(std::size_t posture, const Mat3& rotation, bool from_crowd) const {
    const std::vector<Vec3>& model = posture_places_[posture];
    Naming naming;
    naming.side = side_;
    const Vec3 bodies_at = from_crowd ? crowd_of(places_) : mean_of(places_);
    const Vec3 model_at = from_crowd ? crowd_of(model) : mean_of(model);
    naming.patient_from_model = {rotation, 1.0, bodies_at - rotation * model_at};
    for (int round = 0; round < kRounds; ++round) {
      const auto before = naming.body_of_bone;
      const auto matches = assign(posture, naming);
      if (round > 0 && before == naming.body_of_bone) break;
      refit(matches, naming);
    }
    (void)assign(posture, naming);
    return naming;
  }

  /// More bodies than a wrist has bones, and two pieces more: there are fingers in the scan.
  [[nodiscard]] bool has_more_than_a_wrist() const { return places_.size() > kBoneCount + 2; }

  /// Orientations that lay the model's main axis on that of the bodies, both ways, in all rolls.
  [[nodiscard]] std::vector<Mat3> start_rotations(std::size_t posture) const {
    const Mat3 bodies = principal_frame(places_);
    const Mat3 model = principal_frame(posture_places_[posture]);
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

  /// The middle of the body that has the nearest neighbours, and of those: the carpus.
  static Vec3 crowd_of(std::span<const Vec3> points) {
    constexpr std::size_t kNeighbours = 8;
    Vec3 best = mean_of(points);
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : points) {
      std::vector<Vec3> near(points.begin(), points.end());
      const std::size_t count = std::min(kNeighbours, near.size());
      const auto nearer = [&](const Vec3& a, const Vec3& b) {
        return squared_length(a - p) < squared_length(b - p);
      };
      std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end(),
                        nearer);
      near.resize(count);
      double spread = 0;
      for (const Vec3& q : near) spread += distance(p, q);
      if (spread < least) {
        least = spread;
        best = mean_of(near);
      }
    }
    return best;
  }

  [[nodiscard]] double place_cost(const Naming& naming, const Match& match) const {
    const Vec3 expected = naming.patient_from_model * match.bone_place;
    return std::min(squared_length(match.body_place - expected) / square(kPlaceScaleMm),
                    kMaxPlaceCost);
  }

  /// The body as the bone: a long bone by the ends that the body has, over the same length on both
  /// sides; anything else by all that there is of it.
  [[nodiscard]] Match match(std::size_t posture,
                            std::size_t bone,
                            std::size_t body,
                            const Naming& naming) const {
    const double scale = naming.patient_from_model.scale;
    const double log_scale = std::log(scale);
    const BodyShape& model = (*bones_)[bone];
    const BodyShape& seen = bodies_[body];
    if (!model.is_cut || seen.ends.empty()) {
      Match whole{0, posture_places_[posture][bone], places_[body]};
      whole.cost = place_cost(naming, whole) +
                   shape_cost(body_logs_[body], bone_logs_[bone], log_scale) +
                   (seen.is_cut != model.is_cut ? kCutMismatchCost : 0.0);
      return whole;
    }
    Match best;
    best.cost = std::numeric_limits<double>::infinity();
    for (const JointEnd& end : seen.ends) {
      const JointEnd& model_end = model.ends.front();
      const double length = std::min(model_end.length_mm(), end.length_mm() / scale);
      const EndMeasure of_model = model_end.measure(length);
      const EndMeasure of_body = end.measure(length * scale);
      Match candidate{0, postures_[posture].place(kAllBones[bone], of_model.centroid),
                      of_body.centroid};
      // Of a short stump the tilt of the cut says more than the bone.
      const double trust = square(std::min(1.0, length / kTrustedLengthMm));
      candidate.cost =
          place_cost(naming, candidate) + trust * shape_cost(of_body, of_model, log_scale);
      if (candidate.cost < best.cost) best = candidate;
    }
    return best;
  }

  /// Names all bodies at least cost, and says how each bone was matched.
  std::array<Match, kBoneCount> assign(std::size_t posture, Naming& naming) const {
    const std::size_t n = places_.size();
    const std::size_t size = std::max(n, kBoneCount);
    std::vector<double> costs(size * size, kMissingCost);
    std::vector<Match> matches(kBoneCount * n);
    for (std::size_t b = 0; b < kBoneCount; ++b) {
      for (std::size_t i = 0; i < n; ++i) {
        matches[b * n + i] = match(posture, b, i, naming);
        costs[b * size + i] = std::min(matches[b * n + i].cost, kWorstPair);
      }
    }
    const auto column = assign_at_least_cost(costs, size, size);
    std::array<Match, kBoneCount> chosen;
    naming.cost = 0;
    std::size_t named = 0;
    for (std::size_t b = 0; b < kBoneCount; ++b) {
      const double cost = costs[b * size + column[b]];
      const bool is_body = column[b] < n && cost < kWorstPair;
      naming.body_of_bone[b] = is_body ? std::optional(column[b]) : std::nullopt;
      naming.bone_cost[b] = is_body ? cost : kMissingCost;
      naming.cost += naming.bone_cost[b];
      named += is_body ? 1 : 0;
      if (is_body) chosen[b] = matches[b * n + column[b]];
    }
    naming.cost += kNamelessCost * static_cast<double>(n - named);
    return chosen;
  }

  void refit(const std::array<Match, kBoneCount>& matches, Naming& naming) const {
    std::vector<Vec3> from, to;
    std::vector<double> weights;
    for (std::size_t b = 0; b < kBoneCount; ++b) {
      if (!naming.body_of_bone[b]) continue;
      from.push_back(matches[b].bone_place);
      to.push_back(matches[b].body_place);
      weights.push_back(1 / (1 + naming.bone_cost[b]));
    }
    if (from.size() < 3) return;
    naming.patient_from_model = fit_similarity(from, to, weights, kScaleRange);
  }

  Side side_;
  const ModelShapes* bones_;
  std::vector<Posture> postures_;
  std::vector<std::vector<Vec3>> posture_places_;  ///< [posture][bone] centroid
  std::span<const BodyShape> bodies_;
  std::vector<Vec3> places_;
  std::vector<EndMeasure> body_logs_;
  std::array<EndMeasure, kBoneCount> bone_logs_;
};

/// Best over starts that are tried side by side; the first of equals.
template <typename RotationsOf>
Naming best_of_starts(const Search& search, const RotationsOf& rotations_of) {
  std::vector<Naming> best(search.posture_count());
  parallel_for(best.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t posture = begin; posture < end; ++posture) {
      bool first = true;
      for (const Mat3& rotation : rotations_of(posture)) {
        for (const bool from_crowd : {false, true}) {
          if (from_crowd && !search.has_more_than_a_wrist()) continue;
          const Naming naming = search.improve(posture, rotation, from_crowd);
          if (first || naming.cost < best[posture].cost) best[posture] = naming;
          first = false;
        }
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

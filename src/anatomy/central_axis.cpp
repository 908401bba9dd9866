// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps: (1) longest inner line from pairs of far surface points; (2) the clearance of a cylinder
// is the smallest radial distance of the outer surface samples beside it; (3) it is maximised over
// five freedoms (two tilts, two shifts across, one along) by polling random orthogonal bases with a
// shrinking step, which does not get stuck on the ridges of a max-min problem as coordinate search
// does [audet2006mads]; from many starts on a thinned sample, the best few on the full one.
#include "anatomy/central_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"
#include "core/rng.hpp"

namespace carpus {
namespace {

constexpr std::uint64_t kSearchSeed = 20080101;  // fixed: the same bone gives the same axis
constexpr std::size_t kFreedoms = 5;

constexpr double kSofteningMm = 0.1;  // half the surface noise of a CT at 0.3 to 0.5 mm voxels
constexpr double kOutside = -1e30;

struct Cylinder {
  Vec3 centre;
  Vec3 direction{0, 0, 1};
  double clearance = kOutside;  ///< soft minimum [mm] but for a constant
  double radius = -1.0;         ///< smallest radial distance [mm]
};

class ClearanceSearch {
 public:
  ClearanceSearch(const BoneSolid& bone, std::vector<OuterPoint> points, double half_length)
      : bone_(bone),
        points_(std::move(points)),
        squared_(points_.size()),
        half_length_(half_length) {}

  /// Fills in the cylinder's clearance and radius; kOutside where its axis leaves the bone.
  void measure(Cylinder& cylinder) {
    cylinder.clearance = kOutside;
    for (int i = -4; i <= 4; ++i) {
      if (!bone_.contains(cylinder.centre + cylinder.direction * (half_length_ * i / 4.0))) return;
    }
    constexpr double kBeyondEnds = 1e30;
    double smallest = kBeyondEnds;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec3 w = points_[i].point - cylinder.centre;
      const double t = dot(w, cylinder.direction);
      const bool beside = t <= half_length_ && t >= -half_length_;
      squared_[i] = beside ? squared_length(w) - t * t : kBeyondEnds;
      smallest = std::min(smallest, squared_[i]);
    }
    if (smallest >= kBeyondEnds) return;
    cylinder.radius = std::sqrt(std::max(smallest, 0.0));
    // Farther samples weigh less than exp(-10) and are skipped.
    const double reach = cylinder.radius + 10 * kSofteningMm;
    double sum = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (squared_[i] > reach * reach) continue;
      const double beyond = std::sqrt(std::max(squared_[i], 0.0)) - cylinder.radius;
      sum += points_[i].area_mm2 * std::exp(-beyond / kSofteningMm);
    }
    cylinder.clearance = cylinder.radius - kSofteningMm * std::log(std::max(sum, 1e-12));
  }

  /// Climbs from `start` until steps of `last_step_mm` bring nothing.
  [[nodiscard]] Cylinder climb(Cylinder start,
                               double step_mm,
                               double last_step_mm,
                               int failures_per_step,
                               Rng rng) {
    measure(start);
    if (start.clearance <= kOutside) return start;
    int failures = 0;
    for (int poll = 0; poll < kMaxPolls && step_mm >= last_step_mm; ++poll) {
      if (poll_once(start, step_mm, random_basis(rng))) {
        failures = 0;
      } else if (++failures >= failures_per_step) {
        failures = 0;
        step_mm *= 0.5;
      }
    }
    return start;
  }

 private:
  using Basis = std::array<std::array<double, kFreedoms>, kFreedoms>;
  static constexpr int kMaxPolls = 2000;

  /// Orthonormal basis of the five freedoms, by Gram and Schmidt from random vectors.
  static Basis random_basis(Rng& rng) {
    Basis basis{};
    for (std::size_t i = 0; i < kFreedoms; ++i) {
      double norm = 0;
      while (norm < 1e-3) {
        for (double& value : basis[i]) value = rng.normal();
        for (std::size_t j = 0; j < i; ++j) {
          double projection = 0;
          for (std::size_t k = 0; k < kFreedoms; ++k) projection += basis[i][k] * basis[j][k];
          for (std::size_t k = 0; k < kFreedoms; ++k) basis[i][k] -= projection * basis[j][k];
        }
        norm = 0;
        for (const double value : basis[i]) norm += value * value;
        norm = std::sqrt(norm);
      }
      for (double& value : basis[i]) value /= norm;
    }
    return basis;
  }

  /// Moves to the first of the ten neighbours that is wider.
  bool poll_once(Cylinder& current, double step_mm, const Basis& basis) {
    const Vec3 a = any_perpendicular(current.direction);
    const Vec3 b = cross(current.direction, a);
    for (const auto& delta : basis) {
      for (const double sign : {step_mm, -step_mm}) {
        Cylinder next;
        next.direction =
            normalized_or(current.direction + (a * delta[0] + b * delta[1]) * (sign / half_length_),
                          current.direction);
        next.centre =
            current.centre + (a * delta[2] + b * delta[3] + current.direction * delta[4]) * sign;
        measure(next);
        if (next.clearance > current.clearance) {
          current = next;
          return true;
        }
      }
    }
    return false;
  }

  const BoneSolid& bone_;
  std::vector<OuterPoint> points_;
  std::vector<double> squared_;  ///< radial distances of the cylinder being measured
  double half_length_;
};

std::vector<OuterPoint> every_nth(const std::vector<OuterPoint>& points, std::size_t wanted) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / wanted);
  std::vector<OuterPoint> chosen;
  for (std::size_t i = 0; i < points.size(); i += step) chosen.push_back(points[i]);
  return chosen;
}

bool lies_inside(const BoneSolid& bone, const Vec3& a, const Vec3& b) {
  constexpr double kEndMm = 0.6;  // the ends lie on the surface, where voxels may say outside
  constexpr double kStepMm = 0.4;
  const double length_mm = distance(a, b);
  for (double t = kEndMm; t <= length_mm - kEndMm; t += kStepMm) {
    if (!bone.contains(a + (b - a) * (t / length_mm))) return false;
  }
  return true;
}

BoneLine find_longest_line(const BoneSolid& bone) {
  std::vector<Vec3> points;
  for (const OuterPoint& p : every_nth(bone.outer_points(), 2000)) points.push_back(p.point);
  struct Pair {
    double squared;
    std::size_t a, b;
  };
  std::vector<Pair> pairs;
  double longest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const double squared = squared_length(points[i] - points[j]);
      longest = std::max(longest, squared);
      if (squared > 0.25 * longest) pairs.push_back({squared, i, j});
    }
  }
  // Longest first; of millions few are asked for.
  const auto is_later = [](const Pair& x, const Pair& y) {
    return x.squared != y.squared ? x.squared < y.squared : (x.a != y.a ? x.a > y.a : x.b > y.b);
  };
  std::make_heap(pairs.begin(), pairs.end(), is_later);
  BoneLine line{points.front(), points.front()};
  for (auto end = pairs.end(); end != pairs.begin();) {
    std::pop_heap(pairs.begin(), end--, is_later);
    if (lies_inside(bone, points[end->a], points[end->b])) {
      line = {points[end->a], points[end->b]};
      break;
    }
  }
  // The full sample around both ends: what thinning left out.
  for (int round = 0; round < 2; ++round) {
    for (const auto& [p, area] : bone.outer_points()) {
      const double now = distance(line.start, line.end);
      if (distance(p, line.start) < 2.0 && distance(p, line.end) > now &&
          lies_inside(bone, p, line.end)) {
        line.start = p;
      } else if (distance(p, line.end) < 2.0 && distance(p, line.start) > now &&
                 lies_inside(bone, line.start, p)) {
        line.end = p;
      }
    }
  }
  return line;
}

/// Directions in a cone of 50 degrees about `axis`: the axis itself and four rings.
std::vector<Vec3> directions_about(const Vec3& axis) {
  std::vector<Vec3> directions{axis};
  const Vec3 a = any_perpendicular(axis);
  const Vec3 b = cross(axis, a);
  for (const double tilt_deg : {12.0, 25.0, 38.0, 50.0}) {
    for (int i = 0; i < 8; ++i) {
      const double tilt = tilt_deg * std::numbers::pi / 180;
      const double turn = 2 * std::numbers::pi * i / 8;
      directions.push_back(axis * std::cos(tilt) +
                           (a * std::cos(turn) + b * std::sin(turn)) * std::sin(tilt));
    }
  }
  return directions;
}

Cylinder find_widest_cylinder(const BoneSolid& bone, const BoneLine& longest_line) {
  const double half_length =
      0.5 * kCylinderLengthShare * distance(longest_line.start, longest_line.end);
  Vec3 centroid;
  double area = 0;
  for (const OuterPoint& p : bone.outer_points()) {
    centroid += p.point * p.area_mm2;
    area += p.area_mm2;
  }
  centroid = centroid / area;
  const Vec3 along = normalized_or(longest_line.end - longest_line.start, {0, 0, 1});

  std::vector<Cylinder> found;
  for (const Vec3& direction : directions_about(along)) {
    for (const Vec3& centre : {centroid, (longest_line.start + longest_line.end) * 0.5}) {
      found.push_back({.centre = centre, .direction = direction});
    }
  }
  const ClearanceSearch coarse(bone, every_nth(bone.outer_points(), 900), half_length);
  parallel_for(found.size(), 4, [&](std::size_t begin, std::size_t end) {
    ClearanceSearch search = coarse;
    for (std::size_t i = begin; i < end; ++i) {
      found[i] = search.climb(found[i], 1.6, 0.2, 3, Rng(kSearchSeed));
    }
  });
  std::stable_sort(found.begin(), found.end(),
                   [](const Cylinder& a, const Cylinder& b) { return a.clearance > b.clearance; });
  constexpr std::size_t kRefined = 4;
  found.resize(std::min(kRefined, found.size()));
  const ClearanceSearch fine(bone, bone.outer_points(), half_length);
  parallel_for(found.size(), 1, [&](std::size_t begin, std::size_t end) {
    ClearanceSearch search = fine;
    for (std::size_t i = begin; i < end; ++i) {
      found[i] = search.climb(found[i], 0.4, 0.001, 5, Rng(kSearchSeed + i));
    }
  });
  Cylinder best;
  for (const Cylinder& refined : found) {
    if (refined.clearance > best.clearance) best = refined;
  }
  return best;
}

/// Where the section is smallest between two wider places; the middle of the axis if nowhere.
Vec3 find_waist(const BoneSolid& bone, const BoneLine& axis) {
  const Vec3 along = axis.end - axis.start;
  const Vec3 direction = normalized_or(along, {0, 0, 1});
  constexpr int kSections = 41;         // over the middle 60 % of the axis
  constexpr double kRealWaist = 0.985;  // of the smaller of the two widest places beside it
  std::array<double, kSections> area{};
  const auto share = [](double i) { return 0.2 + 0.6 * i / (kSections - 1); };
  for (int i = 0; i < kSections; ++i) {
    area[static_cast<std::size_t>(i)] =
        bone.section_at(axis.start + along * share(i), direction).area_mm2;
  }
  const auto narrowest =
      static_cast<std::size_t>(std::min_element(area.begin() + 1, area.end() - 1) - area.begin());
  const double before = *std::max_element(area.begin(), area.begin() + narrowest + 1);
  const double after = *std::max_element(area.begin() + narrowest, area.end());
  if (!(area[narrowest] < kRealWaist * std::min(before, after))) return axis.start + along * 0.5;
  return axis.start + along * share(static_cast<double>(narrowest));
}

}  // namespace

std::optional<CentralAxis> find_central_axis(const BoneSolid& bone, const Vec3& towards_start) {
  if (bone.outer_points().size() < 10) return std::nullopt;
  CentralAxis result;
  result.longest_line = find_longest_line(bone);
  if (!(distance(result.longest_line.start, result.longest_line.end) > 0)) return std::nullopt;
  Cylinder cylinder = find_widest_cylinder(bone, result.longest_line);
  if (cylinder.clearance <= kOutside) return std::nullopt;
  if (dot(cylinder.direction, towards_start) > 0) cylinder.direction = -cylinder.direction;
  const auto chord = bone.chord_through(cylinder.centre, cylinder.direction);
  if (!chord) return std::nullopt;
  result.radius_mm = cylinder.radius;
  result.axis = {cylinder.centre + cylinder.direction * chord->enter_mm,
                 cylinder.centre + cylinder.direction * chord->leave_mm};
  if (dot(result.longest_line.end - result.longest_line.start, cylinder.direction) < 0) {
    std::swap(result.longest_line.start, result.longest_line.end);
  }
  result.waist = find_waist(bone, result.axis);
  return result;
}

}  // namespace carpus

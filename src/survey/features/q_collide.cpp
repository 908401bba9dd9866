// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/q_collide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "convex/features/climb.hpp"
#include "convex/features/placement.hpp"
#include "geometry/tolerance.hpp"
#include "survey/features/separating_cone.hpp"

namespace carpus::survey {
namespace {

using convex::MovedBody;

class QCollideQuery final : public convex::PairQuery {
 public:
  QCollideQuery(std::shared_ptr<const convex::VoronoiFeatures> first,
                std::shared_ptr<const convex::VoronoiFeatures> second)
      : first_(std::move(first)), second_(std::move(second)) {}

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& pose) noexcept override {
    const convex::MovedBody second(*first_, *second_, pose);
    if (!second.is_usable()) return convex::Verdict::Unknown;
    if (still_surrounds(second)) return convex::Verdict::Meet;
    if (!has_vector_) {
      vector_ = normalized_or(
          second.linear * second_->interior_point() + second.translation - first_->interior_point(),
          {0, 0, 1});
      has_vector_ = true;
    }
    const VertexDifference found = difference_along(second);
    if (separates(found)) return apart();
    return search(second, found);
  }

  void forget() noexcept override {
    has_vector_ = false;
    witness_.reset();
    on_first_ = 0;
    on_second_ = 0;
  }

 private:
  /// Of the extreme vertices along vector_.
  [[nodiscard]] VertexDifference difference_along(const convex::MovedBody& second) noexcept {
    on_first_ = convex::climb(*first_, vector_, on_first_);
    on_second_ = convex::climb(*second_, second.own(-vector_), on_second_);
    return {second.vertex(on_second_) - first_->vertex(on_first_), on_first_, on_second_};
  }
  [[nodiscard]] bool separates(const VertexDifference& difference) const noexcept {
    return dot(vector_, difference.vector) > kContactToleranceMm;
  }
  [[nodiscard]] convex::Verdict apart() noexcept {
    witness_.reset();
    return convex::Verdict::Apart;
  }

  [[nodiscard]] convex::Verdict search(const convex::MovedBody& second,
                                       VertexDifference found) noexcept {
    if (length(found.vector) <= kContactToleranceMm) return convex::Verdict::Meet;
    cone_.start(tilted(found));
    for (std::size_t cuts = 0; cuts < SeparatingCone::kMostCuts; ++cuts) {
      const Vec3 along = normalized_or(found.vector, vector_);
      vector_ = normalized_or(vector_ - along * (2 * dot(vector_, along)), along);
      if (!cone_.contains(vector_)) vector_ = cone_.centre();
      found = difference_along(second);
      if (separates(found)) return apart();
      if (length(found.vector) <= kContactToleranceMm) return convex::Verdict::Meet;
      const VertexDifference by = tilted(found);
      if (cone_.cut(by, kContactToleranceMm) == SeparatingCone::Cut::Nothing) {
        witness_ = cone_.around_origin(by);
        return convex::Verdict::Meet;
      }
    }
    return convex::Verdict::Unknown;
  }

  /// So that the cone loses vector_ itself, and nothing along which the gap is wider than the
  /// tolerance.
  [[nodiscard]] VertexDifference tilted(VertexDifference difference) const noexcept {
    difference.vector -= vector_ * kContactToleranceMm;
    return difference;
  }

  /// Whether the origin is inside the tetrahedron of the kept vertex pairs' differences.
  [[nodiscard]] bool still_surrounds(const convex::MovedBody& second) const noexcept {
    if (!witness_) return false;
    const std::array<VertexDifference, 4>& witness = *witness_;
    std::array<Vec3, 4> d;
    double size = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const VertexDifference& pair = witness[i];
      d[i] = second.vertex(pair.on_second) - first_->vertex(pair.on_first);
      size = std::max({size, std::abs(d[i].x), std::abs(d[i].y), std::abs(d[i].z)});
    }
    // Six products of three factors, each off by a few roundings of the bodies' size.
    const double rounding = 256 * kRoundoff * size * size * second.scale_mm;
    // Its four faces see the origin on the side of the fourth corner.
    const Vec3 bc = cross(d[1], d[2]);
    const Vec3 ad = cross(d[0], d[3]);
    const double abc = dot(d[0], bc);
    const double dcb = -dot(d[3], bc);
    const double abd = -dot(d[1], ad);
    const double acd = -dot(d[2], ad);
    const auto same = [&](double a, double b, double c, double e) {
      return a > rounding && b > rounding && c > rounding && e > rounding;
    };
    return same(abc, dcb, -abd, acd) || same(-abc, -dcb, abd, -acd);
  }

  std::shared_ptr<const convex::VoronoiFeatures> first_;
  std::shared_ptr<const convex::VoronoiFeatures> second_;
  Vec3 vector_;  // unit, from the first to the second
  bool has_vector_ = false;
  std::uint32_t on_first_ = 0;
  std::uint32_t on_second_ = 0;
  std::optional<std::array<VertexDifference, 4>> witness_;
  SeparatingCone cone_;  // of one query; here because filling it with zeros would cost more than it
};

}  // namespace

std::unique_ptr<convex::PairQuery> make_q_collide(const convex::ConvexBody& first,
                                                  const convex::ConvexBody& second) {
  return make_q_collide(std::make_shared<const convex::VoronoiFeatures>(first),
                        std::make_shared<const convex::VoronoiFeatures>(second));
}

std::unique_ptr<convex::PairQuery> make_q_collide(
    std::shared_ptr<const convex::VoronoiFeatures> first,
    std::shared_ptr<const convex::VoronoiFeatures> second) {
  return std::make_unique<QCollideQuery>(std::move(first), std::move(second));
}

}  // namespace carpus::survey

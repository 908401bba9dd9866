// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies whose surfaces do not touch are apart or nested, and then any corner tells. A facet that
// has a corner of the other body in front of it proves the corner outside; it is kept, and nearly
// always proves it again.
#include "survey/volumes/tree_methods.hpp"

#include <cstddef>
#include <cstdint>

#include "geometry/predicates.hpp"
#include "survey/volumes/surface_query.hpp"

namespace carpus::survey {
namespace {

template <typename Volume>
class TreeQuery final : public convex::PairQuery {
 public:
  TreeQuery(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : first_(first),
        second_(second),
        surfaces_(first.derived<VolumeTree<Volume>>(), second.derived<VolumeTree<Volume>>()) {}

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& first_from_second) noexcept override {
    const SurfaceAnswer answer = surfaces_.query(first_from_second);
    if (answer.touch == SurfaceTouch::Unknown) return convex::Verdict::Unknown;
    if (answer.touch == SurfaceTouch::Touch) return convex::Verdict::Meet;
    if (answer.decided_by_roots) return convex::Verdict::Apart;
    const bool is_nested =
        is_second_within(first_from_second) || is_first_within(first_from_second);
    return is_nested ? convex::Verdict::Meet : convex::Verdict::Apart;
  }
  void forget() noexcept override {
    surfaces_.forget();
    facet_of_first_ = 0;
    facet_of_second_ = 0;
  }

 private:
  bool is_second_within(const convex::PairPose& pose) noexcept {
    const Vec3 corner = moved_corner(pose, second_.vertices().front());
    return is_behind_all(first_, facet_of_first_, corner, 1,
                         [](const Vec3& v) { return without_tiny_coordinates(v); });
  }
  bool is_first_within(const convex::PairPose& pose) noexcept {
    const Vec3 corner = without_tiny_coordinates(first_.vertices().front());
    const double outward = pose.rotation.determinant() < 0 ? -1 : 1;  // of a body's mirror image
    return is_behind_all(second_, facet_of_second_, corner, outward,
                         [&](const Vec3& v) { return moved_corner(pose, v); });
  }

  /// @param proof  the facet to try first; becomes the one that proves the corner outside.
  /// @param outward  -1 where `place` turns the facets inside out, else 1.
  template <typename Place>
  static bool is_behind_all(const convex::ConvexBody& body,
                            std::uint32_t& proof,
                            const Vec3& corner,
                            double outward,
                            Place place) noexcept {
    const ConvexPolytope& hull = body.polytope();
    const auto is_before = [&](std::size_t facet) {
      const Triangle& t = hull.facets[facet];
      return orient3d(place(hull.vertices[t[0]]), place(hull.vertices[t[1]]),
                      place(hull.vertices[t[2]]), corner) *
                 outward >
             0;
    };
    if (is_before(proof)) return false;
    for (std::uint32_t f = 0; f < hull.facets.size(); ++f) {
      if (!is_before(f)) continue;
      proof = f;
      return false;
    }
    return true;
  }

  const convex::ConvexBody& first_;
  const convex::ConvexBody& second_;
  SurfaceQuery<Volume> surfaces_;
  std::uint32_t facet_of_first_ = 0;
  std::uint32_t facet_of_second_ = 0;
};

}  // namespace

template <typename Volume>
std::unique_ptr<convex::PairQuery> make_tree_query(const convex::ConvexBody& first,
                                                   const convex::ConvexBody& second) {
  return std::make_unique<TreeQuery<Volume>>(first, second);
}

template std::unique_ptr<convex::PairQuery> make_tree_query<AxisBox>(const convex::ConvexBody&,
                                                                     const convex::ConvexBody&);
template std::unique_ptr<convex::PairQuery> make_tree_query<OrientedBox>(const convex::ConvexBody&,
                                                                         const convex::ConvexBody&);
template std::unique_ptr<convex::PairQuery> make_tree_query<KDop<6>>(const convex::ConvexBody&,
                                                                     const convex::ConvexBody&);
template std::unique_ptr<convex::PairQuery> make_tree_query<KDop<14>>(const convex::ConvexBody&,
                                                                      const convex::ConvexBody&);
template std::unique_ptr<convex::PairQuery> make_tree_query<KDop<18>>(const convex::ConvexBody&,
                                                                      const convex::ConvexBody&);
template std::unique_ptr<convex::PairQuery> make_tree_query<KDop<26>>(const convex::ConvexBody&,
                                                                      const convex::ConvexBody&);

}  // namespace carpus::survey

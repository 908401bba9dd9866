// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Trees of bounding volumes as methods for convex bodies: surfaces that touch, or a body within the
// other.
#pragma once

#include <memory>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "survey/volumes/axis_box.hpp"
#include "survey/volumes/k_dop.hpp"
#include "survey/volumes/oriented_box.hpp"

namespace carpus::survey {

/// Answers yes or no. Exact for corners of the second body as moved_corner() rounds them; Unknown
/// where the pose is not usable. The tree of a body is shared by all its queries.
template <typename Volume>
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_tree_query(const convex::ConvexBody& first,
                                                                 const convex::ConvexBody& second);

extern template std::unique_ptr<convex::PairQuery> make_tree_query<AxisBox>(
    const convex::ConvexBody&,
    const convex::ConvexBody&);
extern template std::unique_ptr<convex::PairQuery> make_tree_query<OrientedBox>(
    const convex::ConvexBody&,
    const convex::ConvexBody&);
extern template std::unique_ptr<convex::PairQuery> make_tree_query<KDop<6>>(
    const convex::ConvexBody&,
    const convex::ConvexBody&);
extern template std::unique_ptr<convex::PairQuery> make_tree_query<KDop<14>>(
    const convex::ConvexBody&,
    const convex::ConvexBody&);
extern template std::unique_ptr<convex::PairQuery> make_tree_query<KDop<18>>(
    const convex::ConvexBody&,
    const convex::ConvexBody&);
extern template std::unique_ptr<convex::PairQuery> make_tree_query<KDop<26>>(
    const convex::ConvexBody&,
    const convex::ConvexBody&);

}  // namespace carpus::survey

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Trees of bounding volumes as methods for convex bodies: surfaces that touch, or a body within the
// other.
#pragma once

#include <memory>

#include "collision/convex_body.hpp"
#include "collision/pair_query.hpp"
#include "collision/volumes/axis_box.hpp"
#include "collision/volumes/k_dop.hpp"
#include "collision/volumes/oriented_box.hpp"

namespace carpus::collision {

/// Answers yes or no. Exact for corners of the second body as moved_corner() rounds them; Unknown
/// where the pose is not usable. The tree of a body is shared by all its queries.
template <typename Volume>
[[nodiscard]] std::unique_ptr<PairQuery> make_tree_query(const ConvexBody& first,
                                                         const ConvexBody& second);

extern template std::unique_ptr<PairQuery> make_tree_query<AxisBox>(const ConvexBody&,
                                                                    const ConvexBody&);
extern template std::unique_ptr<PairQuery> make_tree_query<OrientedBox>(const ConvexBody&,
                                                                        const ConvexBody&);
extern template std::unique_ptr<PairQuery> make_tree_query<KDop<6>>(const ConvexBody&,
                                                                    const ConvexBody&);
extern template std::unique_ptr<PairQuery> make_tree_query<KDop<14>>(const ConvexBody&,
                                                                     const ConvexBody&);
extern template std::unique_ptr<PairQuery> make_tree_query<KDop<18>>(const ConvexBody&,
                                                                     const ConvexBody&);
extern template std::unique_ptr<PairQuery> make_tree_query<KDop<26>>(const ConvexBody&,
                                                                     const ConvexBody&);

}  // namespace carpus::collision

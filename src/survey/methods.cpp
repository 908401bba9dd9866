// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The one list of methods: a new one is a line here.
#include <algorithm>
#include <array>

#include "convex/growth/growth.hpp"
#include "survey/closest/active_set.hpp"
#include "survey/closest/depth.hpp"
#include "survey/closest/epa.hpp"
#include "survey/closest/gjk.hpp"
#include "survey/features/i_collide.hpp"
#include "survey/features/lin_canny.hpp"
#include "survey/features/q_collide.hpp"
#include "survey/features/swift.hpp"
#include "survey/features/v_clip.hpp"
#include "survey/ivri/ivri_cd.hpp"
#include "survey/lp/seidel.hpp"
#include "survey/lp/three_rows.hpp"
#include "survey/methods.hpp"
#include "survey/volumes/tree_methods.hpp"

namespace carpus::survey {
namespace {

/// Of methods that decide by rounded products of coordinates.
constexpr std::string_view kToRounding = "bodies that touch up to rounding may be called either";
constexpr std::string_view kContactBelow = "gaps below 1e-9 mm count as contact";
constexpr std::string_view kMayGoRound =
    "gaps below 1e-9 mm count as contact; seldom, on needles, the walk goes round without an "
    "answer";

/// Of methods that round the second body's corners into the first one's frame, then are exact.
constexpr std::string_view kToRoundedCorners =
    "bodies that touch up to the rounding of moved corners may be called either";

}  // namespace

std::span<const Method> all_methods() {
  static const std::array kMethods{
      Method{"lp_growth", "ong1996growth", false, false, "", convex::make_growth_query},
      Method{"lp_scan", "yaacoub2008", false, false, "", make_lp_scan},
      Method{"lp_partial", "yaacoub2008", false, false, "", make_lp_partial},
      Method{"lp_walk", "yaacoub2008", false, false, "", make_lp_walk},
      Method{"seidel", "seidel1991small", false, false, "", make_seidel},
      Method{"closest_active_set", "wolfe1976nearest", true, false, "", make_closest_active_set},
      Method{"depth_exact", "vandenbergen2001depth", false, true, "", make_depth_exact},
      Method{"epa", "vandenbergen2001depth", false, true,
             "depth to 1e-6 mm, less where 128 corners do not suffice; bodies that touch up to "
             "rounding may be called either",
             make_epa},
      Method{"gjk", "gilbert1988distance", true, false, kToRounding, make_gjk},
      Method{"gjk_table", "cameron1997enhancing", true, false, kToRounding, make_gjk_table},
      Method{"ivri", "yaacoub2008", false, false,
             "approximate: gaps below 1e-9 mm count as contact; bodies of 1e-3 to 1e5 mm",
             make_ivri_query},
      Method{"aabb_tree", "vandenbergen1997efficient", false, false, kToRoundedCorners,
             make_tree_query<AxisBox>},
      Method{"obb_tree", "gottschalk1996separating", false, false, kToRoundedCorners,
             make_tree_query<OrientedBox>},
      Method{"quick_cd_6", "klosowski1998efficient", false, false, kToRoundedCorners,
             make_tree_query<KDop<6>>},
      Method{"quick_cd_14", "klosowski1998efficient", false, false, kToRoundedCorners,
             make_tree_query<KDop<14>>},
      Method{"quick_cd_18", "klosowski1998efficient", false, false, kToRoundedCorners,
             make_tree_query<KDop<18>>},
      Method{"quick_cd_26", "klosowski1998efficient", false, false, kToRoundedCorners,
             make_tree_query<KDop<26>>},
      Method{"lin_canny", "lin1991incremental", true, false,
             "may not answer on overlap, where the walk goes round; gaps below 1e-9 mm count as "
             "contact",
             make_lin_canny},
      Method{"i_collide", "cohen1995icollide", false, false,
             "of lin_canny, where the boxes overlap", make_i_collide},
      Method{"v_clip", "mirtich1998vclip", true, false, kMayGoRound, make_v_clip},
      Method{"swift", "ehmann2000accelerated", true, false, kMayGoRound, make_swift},
      Method{"q_collide", "chung1996quick", false, false, kContactBelow, make_q_collide},
  };
  return kMethods;
}

const Method* find_method(std::string_view name) {
  const std::span<const Method> methods = all_methods();
  const auto found =
      std::find_if(methods.begin(), methods.end(), [&](const Method& m) { return m.name == name; });
  return found == methods.end() ? nullptr : &*found;
}

}  // namespace carpus::survey

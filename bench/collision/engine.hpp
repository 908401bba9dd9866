// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One method between convex bodies, ours or a peer's, as the collision benchmark sees it: peers
// stand behind the same PairQuery as our own methods.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "convex/pair_query.hpp"

namespace carpus::bench {

struct PairEngine {
  std::string name;
  bool is_peer = false;
  bool gives_distance = false;
  bool gives_depth = false;
  /// Both bodies must outlive the query.
  std::function<std::unique_ptr<convex::PairQuery>(const convex::ConvexBody&,
                                                   const convex::ConvexBody&)>
      make;
};

/// survey::all_methods(), in their order.
[[nodiscard]] std::vector<PairEngine> own_pair_engines();
/// The peers that this machine has: FCL, libccd and Bullet.
[[nodiscard]] std::vector<PairEngine> peer_pair_engines();
/// GLPK and CLP, which solve the thesis's linear program with their own simplex methods.
[[nodiscard]] std::vector<PairEngine> peer_lp_engines();

}  // namespace carpus::bench

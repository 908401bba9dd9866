// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/engine.hpp"
#include "bench/collision/peers.hpp"
#include "survey/methods.hpp"

namespace carpus::bench {
namespace {

[[maybe_unused]] void append(std::vector<PairEngine>& all, std::vector<PairEngine> more) {
  for (PairEngine& e : more) all.push_back(std::move(e));
}

}  // namespace

std::vector<PairEngine> own_pair_engines() {
  std::vector<PairEngine> engines;
  for (const survey::Method& m : survey::all_methods()) {
    engines.push_back({std::string(m.name), false, m.gives_distance, m.gives_depth, m.make});
  }
  return engines;
}

std::vector<PairEngine> peer_pair_engines() {
  std::vector<PairEngine> engines;
#ifdef CARPUS_HAS_COLLISION_FCL
  append(engines, fcl_engines());
#endif
#ifdef CARPUS_HAS_COLLISION_LIBCCD
  append(engines, libccd_engines());
#endif
#ifdef CARPUS_HAS_COLLISION_BULLET
  append(engines, bullet_engines());
#endif
  return engines;
}

std::vector<PairEngine> peer_lp_engines() {
  std::vector<PairEngine> engines;
#ifdef CARPUS_HAS_COLLISION_GLPK
  engines.push_back(glpk_engine());
#endif
#ifdef CARPUS_HAS_COLLISION_CLP
  engines.push_back(clp_engine());
#endif
  return engines;
}

}  // namespace carpus::bench

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/peers.hpp"

namespace carpus::bench {

std::vector<HullEngine> peer_hull_engines() {
  std::vector<HullEngine> engines;
#ifdef CARPUS_HAS_QHULL
  engines.push_back(qhull_engine());
#endif
#ifdef CARPUS_HAS_CGAL
  engines.push_back(cgal_engine());
#endif
#ifdef CARPUS_HAS_BULLET
  engines.push_back(bullet_engine());
#endif
  return engines;
}

}  // namespace carpus::bench

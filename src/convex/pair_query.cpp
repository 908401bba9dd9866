// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/pair_query.hpp"

namespace carpus::convex {

std::optional<Closest> PairQuery::closest(const PairPose& /*first_from_second*/) noexcept {
  return std::nullopt;
}

std::optional<Penetration> PairQuery::penetration(const PairPose& /*first_from_second*/) noexcept {
  return std::nullopt;
}

}  // namespace carpus::convex

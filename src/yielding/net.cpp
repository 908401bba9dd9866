// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "yielding/net.hpp"

#include "core/check.hpp"

namespace carpus::yielding {

void Net::add(const Particle& particle) {
  CARPUS_CHECK(rest_.size() < kMaxParticles);
  scanned_.push_back(particle.scanned);
  rest_.push_back(particle.rest);
  normals_.push_back(particle.normal);
  is_held_.push_back(particle.is_held);
  second_share_.push_back(particle.second_share);
  foundation_mm_per_n_.push_back(particle.foundation_mm_per_n);
  is_between_two_ = is_between_two_ || particle.second_share > 0;
}

void Net::join(std::size_t a, std::size_t b, double n_per_mm, double tension_n) {
  if (is_held_[a] && is_held_[b]) return;
  const double far = distance(rest_[a], rest_[b]);
  springs_.push_back({static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b), far,
                      1 / n_per_mm, tension_n > 0 ? far / tension_n : 0.0});
}

}  // namespace carpus::yielding

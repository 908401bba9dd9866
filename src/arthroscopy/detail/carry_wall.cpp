// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Laplace's equation, screened by what is held, on the surface's edges, each the same, by
// successive over-relaxation in the order of the vertices; then the foremost bodies of each.
#include "arthroscopy/detail/carry_wall.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "mesh/neighbours.hpp"

namespace carpus::arthroscopy::detail {
namespace {

/// Best for a stretch of some 25 vertices between two bones: 2 / (1 + sin(pi / 25)).
constexpr float kRelaxation = 1.78F;
constexpr int kMostSweeps = 400;
constexpr float kSettled = 1e-4F;  ///< of a share, from sweep to sweep: under a micrometre

/// All shares of all vertices; bodies by their place among those that occur.
class Shares {
 public:
  explicit Shares(std::span<const Carried> guess) {
    std::array<bool, 256> occurs{};
    for (const Carried& one : guess) {
      for (std::size_t k = 0; k < Carried::kMost; ++k) {
        if (one.share[k] > 0) occurs[one.body[k]] = true;
      }
    }
    std::array<std::size_t, 256> at{};
    for (std::size_t b = 0; b < occurs.size(); ++b) {
      if (!occurs[b]) continue;
      at[b] = bodies_.size();
      bodies_.push_back(static_cast<std::uint8_t>(b));
    }
    guess_.resize(guess.size() * bodies_.size());
    for (std::size_t v = 0; v < guess.size(); ++v) {
      for (std::size_t k = 0; k < Carried::kMost; ++k) {
        if (guess[v].share[k] <= 0) continue;
        guess_[v * bodies_.size() + at[guess[v].body[k]]] += guess[v].share[k];
      }
    }
    values_ = guess_;
  }

  /// Towards the mean of its neighbours and what holds it. @return by how much it has changed
  float relax(std::size_t v, std::span<const std::uint32_t> about, float hold) {
    float most = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      float sum = 0;
      for (const std::uint32_t n : about) sum += values_[n * bodies_.size() + b];
      const float mean = sum / static_cast<float>(about.size());
      float& mine = values_[v * bodies_.size() + b];
      const float wish = mean + hold * (guess_[v * bodies_.size() + b] - mean);
      const float change = kRelaxation * (wish - mine);
      mine += change;
      most = std::max(most, std::abs(change));
    }
    return most;
  }

  [[nodiscard]] Carried foremost(std::size_t v) const {
    const auto mine = std::span(values_).subspan(v * bodies_.size(), bodies_.size());
    std::vector<std::size_t> order(bodies_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return mine[a] > mine[b]; });
    Carried carried;
    float sum = 0;
    for (std::size_t k = 0; k < std::min(Carried::kMost, order.size()); ++k) {
      carried.body[k] = bodies_[order[k]];
      carried.share[k] = std::max(0.0F, mine[order[k]]);
      sum += carried.share[k];
    }
    for (float& share : carried.share) share /= sum;
    return carried;
  }

 private:
  std::vector<std::uint8_t> bodies_;
  std::vector<float> guess_;
  std::vector<float> values_;
};

}  // namespace

std::vector<Carried> carry_wall(const TriangleMesh& surface,
                                std::span<const Carried> guess,
                                std::span<const float> hold) {
  const std::size_t count = surface.vertices.size();
  if (hold.size() != count || guess.size() != count) {
    throw InvalidInput("carry_wall: a guess and how firmly it holds are wanted for each vertex");
  }
  const mesh::Neighbours neighbours(surface);
  Shares shares(guess);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    float most = 0;
    for (std::size_t v = 0; v < count; ++v) {
      if (hold[v] < 1) most = std::max(most, shares.relax(v, neighbours.of(v), hold[v]));
    }
    if (most < kSettled) break;
  }
  std::vector<Carried> carried;
  carried.reserve(count);
  for (std::size_t v = 0; v < count; ++v) carried.push_back(shares.foremost(v));
  return carried;
}

}  // namespace carpus::arthroscopy::detail

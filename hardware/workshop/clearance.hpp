// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How near the arm's parts come to each other: triangle against triangle, over trees of boxes.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "hardware/workshop/assembly.hpp"

namespace carpus::hardware {

/// Distance of two triangles [mm]: 0 where they meet.
[[nodiscard]] double triangle_distance(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

/// Two pieces that move against each other, and how near they come.
struct Nearness {
  std::string one;
  std::string other;
  double distance_mm = 0;
};

/// Pieces that touch because they are a joint: a ball in its magnet, a shaft in its bearing.
[[nodiscard]] bool is_joint(const std::string& one, const std::string& other);

/// Asks one assembly after the other, of the same arm at other poses: what stands still is prepared
/// once.
class Clearance {
 public:
  Clearance();
  ~Clearance();
  Clearance(const Clearance&) = delete;
  Clearance& operator=(const Clearance&) = delete;

  /// All pairs of pieces of different groups, or of different legs, that are nearer than
  /// `horizon_mm`, but for joints; nearest first. One lying wholly inside another is not seen: it
  /// would have to get there.
  [[nodiscard]] std::vector<Nearness> near_pairs(const std::vector<Piece>& pieces,
                                                 double horizon_mm);

 private:
  class Tree;
  std::vector<std::unique_ptr<Tree>> trees_;
};

}  // namespace carpus::hardware

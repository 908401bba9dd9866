// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/volumes/moved_box.hpp"

#include <algorithm>
#include <limits>

namespace carpus::survey {

MovedBox::MovedBox(std::span<const Vec3> points) {
  for (std::size_t i = 0; i < reaches_.size(); ++i) {
    const auto digit = [&](std::size_t place) {
      const std::size_t d = i / place % 3;
      return static_cast<double>(d) - 1;
    };
    const Vec3 direction{digit(9), digit(3), digit(1)};
    reaches_[i] = -std::numeric_limits<double>::infinity();
    for (const Vec3& p : points) reaches_[i] = std::max(reaches_[i], dot(direction, p));
  }
  for (const Vec3& p : points) {
    size_ = std::max(size_, std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
  }
}

}  // namespace carpus::survey

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue {

double length_of(const Strand& strand) {
  double sum = 0;
  for (std::size_t i = 1; i < strand.course.size(); ++i) {
    sum += distance(strand.course[i - 1], strand.course[i]);
  }
  return sum;
}

}  // namespace carpus::soft_tissue

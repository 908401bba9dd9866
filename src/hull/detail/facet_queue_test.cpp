// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/detail/facet_queue.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace carpus::hull {
namespace {

/// All that comes, in its order; `also` is called with each facet and may push more.
template <typename Also>
std::vector<std::uint32_t> served(FacetQueue& queue, Also also) {
  std::vector<std::uint32_t> facets;
  do {
    while (!queue.is_empty()) {
      facets.push_back(queue.pop().facet);
      also(facets.back());
    }
  } while (queue.next_cell());
  return facets;
}

TEST(FacetQueue, ServesInTheOrderOfComing) {
  FacetQueue queue;
  for (const std::uint32_t f : {5U, 2U, 9U}) queue.push({f, 0}, {});
  const auto facets = served(queue, [&](std::uint32_t f) {
    if (f == 2) queue.push({7, 0}, {});
  });
  EXPECT_EQ(facets, (std::vector<std::uint32_t>{5, 2, 9, 7}));
}

TEST(FacetQueue, DividedServesOneCellAfterAnother) {
  FacetQueue queue;
  queue.divide({0, 0, 0}, {2, 2, 2}, 2);
  const Vec3 low{0.5, 0.5, 0.5};
  const Vec3 high{1.5, 1.5, 1.5};
  queue.push({1, 0}, high);
  queue.push({2, 0}, low);
  queue.push({3, 0}, high);
  const auto facets = served(queue, [&](std::uint32_t f) {
    if (f == 2) {
      queue.push({20, 0}, high);  // comes with its cell
      queue.push({21, 0}, low);   // at once
    }
    if (f == 3) queue.push({30, 0}, low);  // a cell that was finished is taken up again
  });
  EXPECT_EQ(facets, (std::vector<std::uint32_t>{2, 21, 1, 3, 20, 30}));
}

TEST(FacetQueue, TakesPlacesOutsideTheBoxIntoTheCellsAtItsBorder) {
  FacetQueue queue;
  queue.divide({0, 0, 0}, {2, 2, 2}, 2);
  queue.push({1, 0}, {1e9, 1.5, 1.5});
  queue.push({2, 0}, {-1e9, 0.5, 0.5});
  EXPECT_EQ(served(queue, [](std::uint32_t) {}), (std::vector<std::uint32_t>{2, 1}));
}

TEST(FacetQueue, FiltersAndChangesWhatIsToCome) {
  FacetQueue queue;
  queue.divide({0, 0, 0}, {2, 2, 2}, 2);
  for (std::uint32_t f = 0; f < 4; ++f) queue.push({f, 0}, {0.5, 0.5, 0.5});
  for (std::uint32_t f = 4; f < 8; ++f) queue.push({f, 0}, {1.5, 1.5, 1.5});
  ASSERT_TRUE(queue.next_cell());
  queue.pop();
  queue.push({8, 0}, {1.5, 0.5, 0.5});
  queue.push({9, 0}, {1.5, 0.5, 0.5});
  std::uint32_t moved = 100;
  const auto keeps_even = [&](FacetQueue::Entry& entry) {
    entry.first_conflict = moved++;
    return entry.facet % 2 == 0;
  };
  queue.filter_other_cells(keeps_even);
  queue.filter_current(keeps_even);
  ASSERT_EQ(queue.count(), 1U);
  EXPECT_EQ(queue.coming()[0].facet, 2U);
  EXPECT_EQ(queue.coming()[0].first_conflict, 105U);  // after four of the other cell, and facet 1
  ASSERT_EQ(queue.deferred().size(), 1U);
  EXPECT_EQ(queue.deferred()[0].entry.facet, 8U);
  EXPECT_EQ(served(queue, [](std::uint32_t) {}), (std::vector<std::uint32_t>{2, 8, 4, 6}));
}

}  // namespace
}  // namespace carpus::hull

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/drilled_bone.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/units.hpp"

namespace carpus::session {
namespace {

double volume_mm3(const Grid<std::uint8_t>& share) {
  double volume = 0;
  for (const std::uint8_t value : share.values()) volume += value / 255.0;
  return volume * share.geometry().voxel_volume_mm3();
}

TEST(RemovedShare, IsTheVolumeOfTheWay) {
  const simulation::TrackView track{2, {1, 2, 3}, {9, 14, 12}, 1.5, 1.5};
  const double length_mm = distance(track.from_in_bone, track.to_in_bone);
  const double radius = 1.5;
  // Its ends are half balls, as of the wire that made it.
  const double exact = kPi * radius * radius * (length_mm + 4.0 / 3.0 * radius);
  EXPECT_NEAR(volume_mm3(removed_share(std::array{track})), exact, 0.03 * exact);
}

TEST(RemovedShare, CountsWhatTwoWaysShareOnce) {
  const simulation::TrackView track{2, {0, 0, 0}, {0, 0, 10}, 1.0, 1.0};
  EXPECT_DOUBLE_EQ(volume_mm3(removed_share(std::array{track, track})),
                   volume_mm3(removed_share(std::array{track})));
}

TEST(RemovedShare, NothingIsGoneWhereNothingWasDrilled) {
  EXPECT_EQ(removed_share({}).geometry().voxel_count(), 0U);
}

}  // namespace
}  // namespace carpus::session

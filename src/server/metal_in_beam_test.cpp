// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/metal_in_beam.hpp"

#include <gtest/gtest.h>

#include "procedure/screw_catalogue.hpp"

namespace carpus::server {
namespace {

using simulation::Instrument;
using simulation::Snapshot;

Snapshot with_screw(Instrument instrument) {
  Snapshot snapshot;
  snapshot.instrument = instrument;
  snapshot.wire.engaged = true;
  snapshot.wire.entry_in_patient = {1, 2, 3};
  snapshot.wire.tip_in_patient = {1, 2, 27};
  snapshot.wire.direction_in_patient = {0, 0, 1};
  snapshot.screw.index = 3;
  snapshot.screw.length_mm = 20;
  snapshot.screw.advance_mm = 22;
  return snapshot;
}

TEST(MetalInBeam, WireScrewAndDriverAreThereWhileTheDriverHoldsTheScrew) {
  const auto metal = metal_in_beam(with_screw(Instrument::ScrewDriver));
  const auto screw_alone = metal_in_beam(with_screw(Instrument::None));
  EXPECT_EQ(metal.size(), screw_alone.size() + 2) << "the wire and the driver's shaft";
}

TEST(MetalInBeam, NothingStandsOutOfBoneOnceTheScrewLiesAlone) {
  const auto metal = metal_in_beam(with_screw(Instrument::None));
  ASSERT_FALSE(metal.empty());
  for (const auto& part : metal) {
    for (const Vec3& end : {part.start, part.end}) {
      EXPECT_GE(end.z, 3 + 2 - 1e-9) << "the tail is buried by 2 mm";
      EXPECT_LE(end.z, 3 + 22 + 1e-9);
    }
  }
}

}  // namespace
}  // namespace carpus::server

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What turning a screw takes: the bone that its thread cuts, then the pieces that it draws
// together.
#include <algorithm>

#include "instruments/screw_torque.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

namespace {

constexpr int kStations = 6;       // along the thread, in whose bone it is turned
constexpr double kBesideMm = 0.4;  // a voxel of the CT: outside what the thread has cut

}  // namespace

double World::State::torque_n_mm(const Model& model,
                                 const Item& screw,
                                 Driver driver) const noexcept {
  if (driver == Driver::Off) return 0.0;
  const instruments::Instrument& kind = kind_of(model, screw);
  const double engaged = std::clamp(screw.depth_mm(), 0.0, kind.length_mm);
  const double beside = kind.shape.greatest_radius_mm() + kBesideMm;
  const Vec3 aside = any_perpendicular(screw.direction_in_bone) * beside;
  double sum_hu = 0.0;
  for (int i = 0; i < kStations; ++i) {
    const double at = screw.travel_mm - engaged * (i + 0.5) / kStations;
    const Vec3 p = screw.origin_in_bone + screw.direction_in_bone * at;
    const double hu = tissue.density_hu(model.data.ct.view(), screw.body, p + aside);
    sum_hu += hu + tissue.density_hu(model.data.ct.view(), screw.body, p - aside);
  }
  instruments::Threading threading;
  threading.engaged_mm = engaged;
  threading.mean_hu = sum_hu / (2 * kStations);
  threading.diameter_mm = 2 * kind.shape.greatest_radius_mm();
  threading.compression_n = now.compression_n;
  threading.is_stripped = now.is_stripped;
  const double torque = instruments::screw_torque_n_mm(threading);
  return driver == Driver::Forward ? torque : torque * instruments::kLooseningShare;
}

}  // namespace carpus::simulation

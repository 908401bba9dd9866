// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "device_bench/rig.hpp"

#include <algorithm>

#include "device_bench/our_rig.hpp"
#include "device_bench/thesis_rig.hpp"

namespace carpus::device_bench {
namespace {
constexpr double kStartOutsideMm = 10;
}

Rig::Rig(const RigOptions& options) : options_(options), start_(arm::DeltaArm{}.centre) {}

haptics::SurfacePlane Rig::wall() const {
  haptics::SurfacePlane plane;
  plane.normal = options_.normal;
  plane.offset_mm = dot(options_.normal, start_) - kStartOutsideMm + raise_wall_mm;
  plane.feel.stiffness_n_per_mm = options_.stiffness_n_per_mm;
  return plane;
}

double Rig::depth_mm() {
  const haptics::SurfacePlane plane = wall();
  return plane.offset_mm - dot(plane.normal, plant().linkage_state().tip);
}

double Rig::felt_along_n() { return dot(options_.normal, plant().felt_n()); }

double Rig::driven_along_n() {
  return dot(options_.normal, force_of(plant().linkage_state(), booked_));
}

void Rig::book(double seconds,
               const virtual_arm::JointValues& torques,
               const virtual_arm::JointValues& held) {
  const virtual_arm::JointValues& rates = plant().rates();
  for (std::size_t i = 0; i < 3; ++i) {
    booked_[i] = torques[i] - held[i];
    given_mj_ += booked_[i] * rates[i] * seconds;
  }
  most_given_mj_ = std::max(most_given_mj_, given_mj_);
  if (on_step) on_step();
}

std::unique_ptr<Rig> make_rig(const RigOptions& options) {
  if (options.law == Law::Ours) return std::make_unique<OurRig>(options);
  return make_thesis_rig(options);
}

}  // namespace carpus::device_bench

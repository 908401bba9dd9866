// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A hand for tests that knows the answer: places the wire on the synthetic wrist, drives it,
// commands; every input can be recorded.
#pragma once

#include <functional>
#include <utility>

#include "cases/posture.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation::test {

/// The synthetic wrist with its radius turned out of the way by a fixed rotation without sin or cos
/// (cosine 4/5, about 37 degrees of flexion), so that every build has the same bits.
inline const cases::CaseData& posed_wrist() {
  static const cases::CaseData posed = [] {
    cases::CaseData data = cases::test::synthetic_case();
    const Vec3 pivot{-12, 0, -4};
    const Mat3 turn{{Vec3{1, 0, 0}, Vec3{0, 0.8, -0.6}, Vec3{0, 0.6, 0.8}}};
    for (cases::Bone& bone : data.bones) {
      if (belongs_to_forearm(bone.bone)) bone.patient_from_bone = {turn, pivot - turn * pivot};
    }
    return data;
  }();
  return posed;
}

/// Where and how a wire goes in, relative to the central axis.
struct Aim {
  Vec3 entry_offset_mm;   ///< added to the axis' proximal end
  Vec3 distal_offset_mm;  ///< added to its distal end
};

class Operator {
 public:
  /// @param listener  called with every input before it is stepped.
  explicit Operator(const cases::CaseData& posed_case,
                    std::function<void(const Input&)> listener = {})
      : data_(posed_case),
        world_(posed_case, procedure::ProcedureId::DorsalScaphoidFixation, 1),
        listener_(std::move(listener)) {
    const auto& axis = data_.scaphoid.central_axis;
    inward_ = normalized_or(axis.distal - axis.proximal, {0, 0, 1});
    input_.shaft_in_patient = -inward_;
    input_.tip_in_patient = axis.proximal - inward_ * 25.0;
    hold(Driver::Off, 0.0, 20);
  }

  const Snapshot& place_on_entry(const Aim& aim) {
    const auto& axis = data_.scaphoid.central_axis;
    const Vec3 entry = axis.proximal + aim.entry_offset_mm;
    inward_ = normalized_or(axis.distal + aim.distal_offset_mm - entry, inward_);
    input_.shaft_in_patient = -inward_;
    for (double away = 25.0; away > -0.4; away -= 0.05) {
      input_.tip_in_patient = entry - inward_ * away;
      hold(Driver::Off, 0.0, 1);
    }
    return hold(Driver::Off, 0.0, 100);
  }

  const Snapshot& hold(Driver driver, double thrust_n, int ticks) {
    input_.driver = driver;
    input_.thrust_n = thrust_n;
    for (int i = 0; i < ticks; ++i) step();
    return world_.now();
  }

  const Snapshot& drive_to(double depth_mm) {
    for (int i = 0; i < 100000 && world_.now().wire.depth_mm < depth_mm; ++i) {
      hold(Driver::Forward, 30.0, 1);
    }
    return hold(Driver::Off, 0.0, 1);
  }

  const Snapshot& command(const Command& command) {
    input_.command = command;
    step();
    input_.command = {};
    return world_.now();
  }

  [[nodiscard]] const Snapshot& now() const { return world_.now(); }
  [[nodiscard]] World& world() { return world_; }

 private:
  void step() {
    if (listener_) listener_(input_);
    world_.step(input_);
  }

  const cases::CaseData& data_;
  World world_;
  Input input_;
  Vec3 inward_;
  std::function<void(const Input&)> listener_;
};

}  // namespace carpus::simulation::test

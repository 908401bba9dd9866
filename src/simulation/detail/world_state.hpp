// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a world holds while it runs: the case as the tick reads it, and everything that changes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "anatomy/bone_solid.hpp"
#include "core/error.hpp"
#include "haptics/contact_force.hpp"
#include "procedure/screw_catalogue.hpp"
#include "simulation/detail/bone_contact.hpp"
#include "simulation/detail/operation_state.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {

namespace detail {
/// Its place in Operated::completed_steps.
[[nodiscard]] constexpr std::uint32_t step_bit(procedure::Step step) noexcept {
  return 1U << static_cast<unsigned>(step);
}
}  // namespace detail

struct World::Model {
  explicit Model(const cases::CaseData& data)
      : posed_case(data), ct(data.ct.view()), contact(data), scaphoid(solid_of(data)) {
    for (const procedure::Screw& screw : procedure::screw_catalogue()) {
      if (screw_count == screw_lengths.size()) break;
      screw_lengths[screw_count++] = screw.length_mm;
    }
  }

  static BoneSolid solid_of(const cases::CaseData& data) {
    std::vector<const TriangleMesh*> fragments;
    for (const cases::Bone* part : cases::scaphoid_parts(data)) fragments.push_back(&part->surface);
    if (fragments.empty()) throw InvalidInput("simulation: the case has no scaphoid to operate on");
    if (data.ct.values().empty()) {
      throw InvalidInput("simulation: the case has no CT; resistance and pictures come from it");
    }
    return BoneSolid(fragments);
  }

  /// Length of the line from `entry` along `direction` inside the scaphoid [mm].
  [[nodiscard]] double chord_mm(const Vec3& entry, const Vec3& direction) const noexcept {
    constexpr double kStepMm = 0.1;
    constexpr int kSteps = 600;
    double last_inside = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
      const double t = i * kStepMm;
      if (scaphoid.contains(entry + direction * t)) last_inside = t;
    }
    return last_inside;
  }

  const cases::CaseData& posed_case;
  GridView<const std::int16_t> ct;
  detail::BoneContact contact;
  BoneSolid scaphoid;
  std::array<double, 256> screw_lengths{};
  std::size_t screw_count = 0;
  procedure::ProcedureId procedure = procedure::ProcedureId::DorsalScaphoidFixation;
  std::uint64_t seed = 0;
};

/// Everything that changes, and what changes it.
struct World::State {
  detail::Operated now;
  detail::Spent spent;
  Snapshot snapshot;
  TickFaults faults;
  haptics::ForceLimiter limiter;
  std::array<procedure::Shot, kMaxShots> shots{};
  std::array<detail::Operated, detail::kMaxCheckpoints> checkpoints{};
  std::size_t checkpoint_count = 0;

  void step(Model& model, const Input& raw) noexcept;

 private:
  [[nodiscard]] Input checked(const Input& raw) noexcept;
  void emit(EventKind kind, std::int32_t detail, double value) noexcept;
  void refuse(CommandKind kind) noexcept;
  void save_checkpoint() noexcept;

  void obey(const Model& model, const Command& command) noexcept;
  void take_shot(const Command& command) noexcept;
  void measure(const Model& model) noexcept;
  void select_screw(const Model& model, std::int32_t index) noexcept;
  void undo() noexcept;
  void finish() noexcept;

  void move_free_wire(Model& model, const Input& input) noexcept;
  void chase(Model& model, const detail::NearBones& near, const Vec3& target) noexcept;
  void turn_towards(const Vec3& shaft) noexcept;
  void rest_or_engage(const Model& model,
                      const detail::NearBones& near,
                      const Input& input) noexcept;
  void engage(const Model& model, const detail::SurfacePoint& surface) noexcept;
  void enter_scaphoid(const Model& model) noexcept;
  void drive_wire(const Model& model, const Input& input) noexcept;
  void note_tip(const Model& model) noexcept;
  void withdraw() noexcept;
  void drive_screw(const Model& model, const Input& input) noexcept;
  void unload_screw() noexcept;

  void tick_off_steps() noexcept;
  [[nodiscard]] bool are_views_enough(std::uint32_t first_shot, bool needs_oblique) const noexcept;
  void complete(procedure::Step step) noexcept;
  void publish(const Model& model, const Input& input, const Vec3& hand_velocity) noexcept;
  void publish_wire(const Model& model) noexcept;
  void update_hash(const Model& model) noexcept;

  [[nodiscard]] Vec3 entry() const noexcept {
    return now.wire.origin + now.wire.direction * now.wire.entry_at_mm;
  }
  [[nodiscard]] Vec3 wire_tip() const noexcept {
    return now.wire.origin + now.wire.direction * now.wire.travel_mm;
  }
  [[nodiscard]] double depth_mm() const noexcept {
    return now.wire.travel_mm - (now.wire.in_scaphoid ? now.wire.entry_at_mm : 0.0);
  }
  [[nodiscard]] double buried_mm() const noexcept {
    return now.screw.advance_mm - now.screw.length_mm;
  }
};

}  // namespace carpus::simulation

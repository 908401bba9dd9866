// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The world of one exercise, advanced by fixed ticks of 1 ms. The same case, seed and inputs give
// the same bytes on every machine and at every optimisation level: a step uses only + - * / and
// sqrt, allocates nothing, takes no lock and reads no clock.
#pragma once

#include <cstdint>
#include <memory>

#include "cases/case_data.hpp"
#include "procedure/operation_record.hpp"
#include "procedure/procedure_id.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation {

/// Shots that one exercise can hold; further ones are refused.
inline constexpr std::size_t kMaxShots = 512;

/// How often the inside of the tick had to give way; all zero in a healthy run.
struct TickFaults {
  std::uint64_t bad_inputs = 0;     ///< not finite or out of range; the last good one was used
  std::uint64_t forces_zeroed = 0;  ///< not finite before the limiter
  std::uint64_t unresolved_contacts = 0;  ///< wire wedged: it stayed where it was
  std::uint64_t lost_events = 0;          ///< more than kMaxEventsPerTick
};

class World {
 public:
  /// Sets up an exercise; takes about 0.2 s and all the memory that it will need.
  /// @param posed_case  the case in its operative posture (cases::apply_posture), with distance
  ///                    fields and hulls; it must outlive the world and not change.
  /// @throws InvalidInput when the case lacks a scaphoid, a CT or a bone's distance field.
  World(const cases::CaseData& posed_case, procedure::ProcedureId procedure, std::uint64_t seed);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Advances by one tick. After Command::Finish the world stands still and returns the last state.
  const Snapshot& step(const Input& input) noexcept;

  /// The state after the last tick.
  [[nodiscard]] const Snapshot& now() const noexcept;

  /// What the score needs; allocates, not for the 1 kHz thread.
  [[nodiscard]] procedure::OperationRecord operation_record() const;

  [[nodiscard]] const TickFaults& faults() const noexcept;
  [[nodiscard]] procedure::ProcedureId procedure() const noexcept;
  [[nodiscard]] std::uint64_t seed() const noexcept;
  [[nodiscard]] const cases::CaseData& posed_case() const noexcept;

 private:
  struct Model;  ///< fixed: fields, hulls, catalogue
  struct State;  ///< plain data, copied for checkpoints
  std::unique_ptr<Model> model_;
  std::unique_ptr<State> state_;
};

}  // namespace carpus::simulation

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The world of one exercise, advanced by fixed ticks of 1 ms: bodies with poses, instruments in two
// hands or left in bone, bone that changes, a declared procedure. The same case, procedure, seed
// and inputs give the same bytes on every machine and at every optimisation level: a step uses only
// + - * / and sqrt, allocates nothing, takes no lock and reads no clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "cases/joint_lesions.hpp"
#include "core/result.hpp"
#include "procedure/mode.hpp"
#include "procedure/operation_record.hpp"
#include "procedure/procedure.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation {

/// Shots that one exercise can hold; further ones are refused.
inline constexpr std::size_t kMaxShots = 512;

/// How often the inside of the tick had to give way; all zero in a healthy run.
struct TickFaults {
  std::uint64_t bad_inputs = 0;     ///< not finite or out of range; the last good one was used
  std::uint64_t forces_zeroed = 0;  ///< not finite before the limiter
  std::uint64_t unresolved_contacts = 0;  ///< an instrument is wedged: it stayed where it was
  std::uint64_t lost_events = 0;          ///< more than kMaxEventsPerTick
  std::uint64_t lost_cuts = 0;            ///< the reserve for changed bone is used up
};

class World {
 public:
  /// Sets up an exercise; takes about 0.2 s and all the memory that it will need.
  /// @param data  the case as scanned, with distance fields, CT and hand motion; it and the
  ///              procedure must outlive the world and not change.
  /// @param prepared  what is wrong in a wrist that is examined; none: the seed decides.
  /// @throws InvalidInput when the case lacks what the procedure operates on, a CT or a bone's
  ///     distance field.
  World(const cases::CaseData& data,
        const procedure::Procedure& procedure,
        std::uint64_t seed,
        procedure::Mode mode,
        const std::optional<cases::PreparedPathology>& prepared);
  /// As the case has it prepared. A replay names what its recording had instead.
  World(const cases::CaseData& data,
        const procedure::Procedure& procedure,
        std::uint64_t seed,
        procedure::Mode mode = procedure::Mode::Practice);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Advances by one tick with the quantised input. After Finish the world stands still and returns
  /// the last state.
  const Snapshot& step(const Input& input) noexcept;

  /// From now on no tick is hashed, which is a third of its time: for studies that keep no
  /// recording. All else stays the same.
  void leave_out_hashes() noexcept;

  /// The state after the last tick.
  [[nodiscard]] const Snapshot& now() const noexcept;

  /// What the score needs; allocates, not for the 1 kHz thread.
  [[nodiscard]] procedure::OperationRecord operation_record() const;

  /// Everything that decides the future, for keyframes. Not for the 1 kHz thread.
  [[nodiscard]] std::vector<std::byte> write_state() const;
  /// Takes over a state that write_state made, of the same case and procedure. Untrusted bytes: a
  /// refusal leaves the world as it was.
  [[nodiscard]] Result<bool> read_state(std::span<const std::byte> bytes);

  [[nodiscard]] const TickFaults& faults() const noexcept;
  [[nodiscard]] const procedure::Procedure& procedure() const noexcept;
  [[nodiscard]] std::uint64_t seed() const noexcept;
  /// What was prepared to be wrong; none where the seed decides, or it is no examination.
  [[nodiscard]] const std::optional<cases::PreparedPathology>& prepared() const noexcept;
  /// What is wrong in the joints of this exercise; nullptr where it is no examination.
  [[nodiscard]] const cases::JointLesions* lesions() const noexcept;
  [[nodiscard]] procedure::Mode mode() const noexcept;
  [[nodiscard]] const cases::CaseData& case_data() const noexcept;

 private:
  struct Model;  ///< fixed: bodies, shapes, the target's solid
  struct State;  ///< what changes
  std::unique_ptr<Model> model_;
  std::unique_ptr<State> state_;
};

}  // namespace carpus::simulation

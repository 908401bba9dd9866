// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One page and one exercise, on any host: what the page says becomes input, what the world leaves
// becomes messages. Knows no thread, socket or clock; the host carries frames, keeps time, makes
// pictures and stores.
//
//   page ──text──▶ session ──HeldInput, Command──▶ InputSource ──Input──▶ World
//   page ◀─text─── session ◀──────────── Snapshot ─────────────────────── World
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "protocol/messages.hpp"
#include "session/body_names.hpp"
#include "session/page_input.hpp"
#include "session/reduction_hint.hpp"
#include "session/snapshot_message.hpp"

namespace carpus::session {

class Session {
 public:
  /// @param data, procedure  must outlive it. @param initial  state before the first tick.
  Session(const cases::CaseData& data,
          const procedure::Procedure& procedure,
          const simulation::Snapshot& initial);

  // From the page. What is held goes to InputSource::hold, a command into a tick's input.
  const HeldInput& take(const protocol::Hand& message) noexcept;
  const HeldInput& take(const protocol::Wrist& message) noexcept;
  [[nodiscard]] Result<simulation::Command> take(const protocol::Act& message) const;
  /// Moves the C-arm there, too.
  [[nodiscard]] simulation::Command take(const protocol::TakeShot& message) noexcept;
  [[nodiscard]] static simulation::Command take(const protocol::Tube& message) noexcept;
  [[nodiscard]] static simulation::Command take(const protocol::TurnScope& message) noexcept;
  [[nodiscard]] static simulation::Command take(const protocol::TurnMouth& message) noexcept;
  [[nodiscard]] static simulation::Command take(const protocol::SetFluid& message) noexcept;
  [[nodiscard]] Result<simulation::Command> take(const protocol::Answer& message) const;
  const HeldInput& take(const protocol::CArm& message) noexcept;
  const HeldInput& take(const protocol::Pedal& message) noexcept;
  [[nodiscard]] const HeldInput& held() const noexcept { return held_; }
  /// The page is gone: drivers off, everything stays where it is.
  const HeldInput& let_go() noexcept;

  // To the page.
  /// To be sent first, and again to a page that comes back.
  [[nodiscard]] protocol::Exercise exercise() const;
  /// What the page does not know yet of this state, in the order in which it must be sent: bone
  /// that was removed, what can be asked for, the state itself. All of it is taken for sent.
  [[nodiscard]] std::vector<protocol::HostMessage> update(const simulation::Snapshot& now,
                                                          const HostState& host);
  /// A page came back: the next update tells everything.
  void forget_what_was_sent() noexcept;
  /// For the records: everything.
  [[nodiscard]] protocol::LoggedEvent describe(const simulation::Event& event) const;
  /// For the page: in practice with a hint, in an assessed operation only what it would notice;
  /// empty where that is nothing. @param then  state that the event's tick left.
  [[nodiscard]] std::optional<protocol::LoggedEvent> tell(const simulation::Event& event,
                                                          const simulation::Snapshot& then) const;

 private:
  using BonePose = Pose<frame::Patient, frame::Bone>;

  [[nodiscard]] bool is_aimed() const noexcept { return aim_.body < data_.bones.size(); }
  /// On request: of what is in that hand, in bone or not.
  [[nodiscard]] std::string hint_for(std::uint8_t item, const simulation::Snapshot& then) const;
  [[nodiscard]] std::string hint_on(const simulation::Event& event,
                                    const simulation::Snapshot& then) const;

  const cases::CaseData& data_;
  const procedure::Procedure& procedure_;
  BodyNames bodies_;
  procedure::Aim aim_;
  std::optional<BrokenBone> broken_;  ///< the bone that is operated on, where it is in pieces
  HeldInput held_;
  simulation::Snapshot latest_;
  std::optional<std::uint32_t> sent_tissue_;
  std::vector<BonePose> sent_poses_;
  protocol::Actions sent_actions_;
  std::optional<protocol::Scope> sent_scope_;
  std::optional<protocol::Skin> sent_skin_;
  std::array<std::optional<protocol::Sheet>, simulation::kMaxSheets> sent_sheets_;
};

}  // namespace carpus::session

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/session.hpp"

#include <string>
#include <utility>

#include "procedure/aid.hpp"
#include "session/action_list.hpp"
#include "session/descriptions.hpp"
#include "session/entry_hint.hpp"
#include "session/event_text.hpp"
#include "session/scope_message.hpp"
#include "session/skin_message.hpp"

namespace carpus::session {

Session::Session(const cases::CaseData& data,
                 const procedure::Procedure& procedure,
                 const simulation::Snapshot& initial)
    : data_(data),
      procedure_(procedure),
      bodies_(data),
      aim_(procedure.opening(data).aim),
      broken_(broken_bone_of(data, procedure.target)),
      held_(resting(initial)),
      latest_(initial) {}

const HeldInput& Session::take(const protocol::Hand& message) noexcept {
  hold(held_, message);
  return held_;
}

const HeldInput& Session::take(const protocol::Wrist& message) noexcept {
  hold(held_, message);
  return held_;
}

Result<simulation::Command> Session::take(const protocol::Act& message) const {
  return command_of(message, procedure_);
}

simulation::Command Session::take(const protocol::TakeShot& message) noexcept {
  const simulation::Command command = command_of(message, latest_.wrist);
  held_.c_arm.rotation_deg = command.rotation_deg;
  held_.c_arm.tilt_deg = command.tilt_deg;
  return command;
}

simulation::Command Session::take(const protocol::Tube& message) noexcept {
  return command_of(message);
}

Result<simulation::Command> Session::take(const protocol::Answer& message) const {
  return command_of(message, procedure_);
}

simulation::Command Session::take(const protocol::TurnScope& message) noexcept {
  return command_of(message);
}

simulation::Command Session::take(const protocol::TurnMouth& message) noexcept {
  return command_of(message);
}

simulation::Command Session::take(const protocol::SetFluid& message) noexcept {
  return command_of(message);
}

const HeldInput& Session::take(const protocol::CArm& message) noexcept {
  hold(held_, message, latest_.wrist);
  return held_;
}

const HeldInput& Session::take(const protocol::Pedal& message) noexcept {
  hold(held_, message);
  return held_;
}

const HeldInput& Session::let_go() noexcept {
  const auto heard = held_.heard;
  held_ = resting(latest_);
  held_.heard = heard;
  return held_;
}

protocol::Exercise Session::exercise() const {
  return exercise_message(data_, procedure_, aim_, latest_);
}

std::vector<protocol::HostMessage> Session::update(const simulation::Snapshot& now,
                                                   const HostState& host) {
  latest_ = now;
  std::vector<protocol::HostMessage> messages;
  if (sent_tissue_ != now.tissue_revision) {
    messages.emplace_back(tissue_message(now, bodies_));
    sent_tissue_ = now.tissue_revision;
  }
  protocol::Actions actions = actions_message(procedure_, now, bodies_);
  if (actions != sent_actions_) {
    messages.emplace_back(actions);
    sent_actions_ = std::move(actions);
  }
  protocol::Snapshot snapshot = snapshot_message(now, host, bodies_);
  const std::vector<BonePose> poses(now.patient_from_bone.begin(),
                                    now.patient_from_bone.begin() + now.body_count);
  if (poses != sent_poses_) {
    snapshot.bodies = body_poses(now);
    sent_poses_ = poses;
  }
  messages.emplace_back(std::move(snapshot));
  std::optional<protocol::Scope> scope = scope_message(data_, procedure_, now);
  if (scope && scope != sent_scope_) messages.emplace_back(*scope);
  sent_scope_ = std::move(scope);
  std::optional<protocol::Skin> skin = skin_message(data_, bodies_, now);
  if (skin && skin != sent_skin_) messages.emplace_back(*skin);
  sent_skin_ = std::move(skin);
  for (std::size_t s = 0; s < now.sheet_count; ++s) {
    protocol::Sheet sheet = sheet_message(now, s);
    if (sheet == sent_sheets_[s]) continue;
    messages.emplace_back(sheet);
    sent_sheets_[s] = std::move(sheet);
  }
  return messages;
}

void Session::forget_what_was_sent() noexcept {
  sent_tissue_.reset();
  sent_poses_.clear();
  sent_actions_.actions.clear();
  sent_scope_.reset();
  sent_skin_.reset();
  for (auto& sheet : sent_sheets_) sheet.reset();
}

protocol::LoggedEvent Session::describe(const simulation::Event& event) const {
  return session::describe(event, procedure_, bodies_);
}

/// Of a wire that went into what is operated on; empty for all else.
std::string Session::hint_on(const simulation::Event& event,
                             const simulation::Snapshot& then) const {
  const auto body = static_cast<std::size_t>(event.detail);
  if (event.item >= simulation::kMaxItems || body >= data_.bones.size() ||
      data_.bones[body].bone != procedure_.target) {
    return {};
  }
  const simulation::ItemView& item = then.items[event.item];
  const auto all = instruments::catalogue();
  if (item.instrument >= all.size() || all[item.instrument].work != instruments::Work::Drill ||
      !item.in_target) {
    return {};
  }
  return is_aimed() ? ". " + entry_hint(data_, aim_, then, item) : std::string();
}

std::string Session::hint_for(std::uint8_t item, const simulation::Snapshot& then) const {
  if (item >= simulation::kMaxItems ||
      then.items[item].instrument >= instruments::catalogue().size()) {
    return "take a wire, then ask again.";
  }
  if (broken_ && instruments::catalogue()[then.items[item].instrument].is_joystick) {
    return reduction_hint(data_, *broken_, then);
  }
  if (!is_aimed()) return "this procedure has none.";
  simulation::ItemView held = then.items[item];
  if (held.body == simulation::kNoBody) held.entry_in_patient = held.tip_in_patient;
  return entry_hint(data_, aim_, then, held);
}

std::optional<protocol::LoggedEvent> Session::tell(const simulation::Event& event,
                                                   const simulation::Snapshot& then) const {
  if (then.mode == procedure::Mode::Practice) {
    protocol::LoggedEvent told = describe(event);
    if (event.kind == simulation::EventKind::EnteredBone) told.text += hint_on(event, then);
    const bool is_hint = event.kind == simulation::EventKind::AidUsed &&
                         event.detail == static_cast<std::int32_t>(procedure::Aid::Hint);
    if (is_hint) told.text = "Hint: " + hint_for(event.item, then);
    return told;
  }
  return describe_blind(event, procedure_, bodies_);
}

}  // namespace carpus::session

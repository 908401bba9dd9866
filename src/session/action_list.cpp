// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/action_list.hpp"

#include <string>
#include <utility>

#include "instruments/instrument.hpp"
#include "session/refusal_text.hpp"
#include "simulation/permission.hpp"

namespace carpus::session {

namespace {

using protocol::ActionId;
using simulation::Command;
using simulation::CommandKind;

class ActionList {
 public:
  ActionList(const procedure::Procedure& procedure,
             const simulation::Snapshot& now,
             const BodyNames& bodies)
      : procedure_(procedure), now_(now), bodies_(bodies) {}

  [[nodiscard]] protocol::Actions made() {
    for (std::uint8_t hand = 0; hand < simulation::kHands; ++hand) add_hand(hand);
    add(ActionId::TakeShot, {CommandKind::TakeShot}, "Take a picture").hand = -1;
    add(ActionId::Undo, {CommandKind::Undo}, "Back to the last checkpoint").hand = -1;
    add_steps();
    add(ActionId::Finish, {CommandKind::Finish}, "Finish the operation").hand = -1;
    add(ActionId::UseAid, {CommandKind::UseAid}, "Aids").hand = -1;
    const auto first_answer = static_cast<std::uint8_t>(procedure::Judgement::Aligned);
    add(ActionId::Judge, {CommandKind::Judge, 0, first_answer}, "Judge the fracture").hand = -1;
    // Whether it can be declined at all: the first reason stands for any.
    add(ActionId::Decline, {CommandKind::Decline, 0, 1}, "Decline to operate").hand = -1;
    return std::move(message_);
  }

 private:
  /// Those that were done: what lies before the first checkpoint is refused with its reason.
  void add_steps() {
    for (std::uint8_t step = 0; step < procedure_.steps.size(); ++step) {
      if ((now_.completed_steps >> step & 1U) == 0) continue;
      protocol::Action& action = add(ActionId::ReturnToStep, {CommandKind::ReturnToStep, 0, step},
                                     "Do this step again: " + procedure_.steps[step].title);
      action.hand = -1;
      action.item = step;
    }
  }

  void add_hand(std::uint8_t hand) {
    const auto all = instruments::catalogue();
    for (const instruments::InstrumentIndex index : procedure_.tray) {
      const instruments::Instrument& instrument = all[index];
      add(ActionId::Take, {CommandKind::Take, hand, index}, "Take: " + instrument.name).instrument =
          instrument.id;
    }
    add(ActionId::PutDown, {CommandKind::PutDown, hand}, "Put down " + held(hand));
    add(ActionId::ReadGauge, {CommandKind::ReadGauge, hand}, "Read the gauge");
    for (std::uint8_t i = 0; i < simulation::kMaxItems; ++i) {
      const simulation::ItemView& item = now_.items[i];
      if (item.instrument >= all.size() || item.hand != simulation::kNoHand) continue;
      add(ActionId::PickUp, {CommandKind::PickUp, hand, i},
          "Take hold of: " + all[item.instrument].name + where(item))
          .item = i;
      if (!all[item.instrument].is_double_pointed || item.body == simulation::kNoBody) continue;
      add(ActionId::PickUpFarEnd, {CommandKind::PickUpFarEnd, hand, i},
          "Take hold of the other end of: " + all[item.instrument].name)
          .item = i;
    }
  }

  [[nodiscard]] std::string held(std::uint8_t hand) const {
    const auto all = instruments::catalogue();
    const std::uint8_t item = now_.hands[hand].item;
    if (item >= simulation::kMaxItems || now_.items[item].instrument >= all.size()) {
      return "what the hand holds";
    }
    return all[now_.items[item].instrument].name;
  }

  [[nodiscard]] std::string where(const simulation::ItemView& item) const {
    if (item.body == simulation::kNoBody) return {};
    if (now_.mode == procedure::Mode::Assessed) return ", in bone";
    return ", in the " + bodies_.words(item.body);
  }

  protocol::Action& add(ActionId id, const Command& command, std::string label) {
    const simulation::Refusal refusal = simulation::why_not(procedure_, now_, command);
    protocol::Action action;
    action.id = id;
    action.hand = command.hand;
    action.item = -1;
    action.label = std::move(label);
    action.allowed = refusal == simulation::Refusal::None;
    action.refusal = simulation::name_of(refusal);
    action.reason = text_of(refusal);
    return message_.actions.emplace_back(std::move(action));
  }

  const procedure::Procedure& procedure_;
  const simulation::Snapshot& now_;
  const BodyNames& bodies_;
  protocol::Actions message_;
};

}  // namespace

protocol::Actions actions_message(const procedure::Procedure& procedure,
                                  const simulation::Snapshot& now,
                                  const BodyNames& bodies) {
  return ActionList(procedure, now, bodies).made();
}

}  // namespace carpus::session

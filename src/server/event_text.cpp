// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/event_text.hpp"

#include <array>
#include <cstdio>

#include "anatomy/bone_id.hpp"
#include "anatomy/bone_words.hpp"
#include "procedure/screw_catalogue.hpp"
#include "procedure/step.hpp"
#include "simulation/input.hpp"

namespace carpus::server {

namespace {

using simulation::CommandKind;
using simulation::EventKind;

std::string with_mm(const char* what, double mm) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%s %.1f mm", what, mm);
  return text.data();
}

/// Which part of a broken scaphoid it was is told of the distal one only: the label of the proximal
/// part is the whole bone's.
std::string bone_in_words(int label) {
  if (label == kScaphoidDistalLabel) {
    return std::string(words_of(BoneId::Scaphoid, BonePart::Distal));
  }
  for (const BoneId bone : kAllBones) {
    if (static_cast<int>(bone) == label) return std::string(words_of(bone));
  }
  return "bone";
}

std::string refused_text(int command) {
  switch (static_cast<CommandKind>(command)) {
    case CommandKind::TakeShot:
      return "No more pictures can be taken in this exercise";
    case CommandKind::Measure:
      return "Nothing to measure: the guide wire is not in the bone";
    case CommandKind::SelectScrew:
      return "The screw cannot be loaded: the guide wire must lie in the scaphoid, and the screw "
             "must be one of the tray";
    case CommandKind::Undo:
      return "Nothing to undo";
    case CommandKind::Finish:
      return "The operation is finished already";
    case CommandKind::None:
      break;
  }
  return "That is not possible now";
}

std::string screw_name(int index) {
  const auto screws = procedure::screw_catalogue();
  if (index < 0 || static_cast<std::size_t>(index) >= screws.size()) return "Screw put back";
  return screws[static_cast<std::size_t>(index)].name + " loaded";
}

std::string text_of(const simulation::Event& event) {
  switch (event.kind) {
    case EventKind::TouchedBone:
      return "Touched the " + bone_in_words(event.detail);
    case EventKind::WireEngaged:
      return "Wire entered the " + bone_in_words(event.detail);
    case EventKind::WireLeftBone:
      return "Wire came out of the far side of the " + bone_in_words(event.detail);
    case EventKind::WireWithdrawn:
      return "Wire withdrawn";
    case EventKind::ShotTaken:
      return "Picture " + std::to_string(event.detail);
    case EventKind::Measured:
      return with_mm("Depth gauge reads", event.value);
    case EventKind::ScrewSelected:
      return screw_name(event.detail);
    case EventKind::ScrewSeated:
      return with_mm("Screw level with the bone, buried", event.value);
    case EventKind::StepCompleted:
      return "Step done: " +
             std::string(procedure::name_of(static_cast<procedure::Step>(event.detail)));
    case EventKind::Undone:
      return "Back to the last checkpoint";
    case EventKind::Finished:
      return "Operation finished";
    case EventKind::Refused:
      return refused_text(event.detail);
    case EventKind::WrongBone:
      return "Wire entered the " + bone_in_words(event.detail) + ", which is not the scaphoid";
    case EventKind::Slipped:
      return "The wire slipped along the " + bone_in_words(event.detail) +
             ": hold it steeper to the surface";
    case EventKind::None:
      break;
  }
  return {};
}

}  // namespace

std::string_view name_of(EventKind kind) noexcept {
  constexpr std::array<std::string_view, 15> kNames{
      "none",       "touched_bone", "wire_engaged",   "wire_left_bone", "wire_withdrawn",
      "shot_taken", "measured",     "screw_selected", "screw_seated",   "step_completed",
      "undone",     "finished",     "refused",        "wrong_bone",     "slipped"};
  const auto index = static_cast<std::size_t>(kind);
  return index < kNames.size() ? kNames[index] : kNames[0];
}

protocol::LoggedEvent describe(const simulation::Event& event) {
  return {static_cast<std::int64_t>(event.tick), std::string(name_of(event.kind)), text_of(event)};
}

std::string bone_name_of_label(int label, bool broken_scaphoid) {
  if (label == kScaphoidDistalLabel)
    return std::string(name_of(BoneId::Scaphoid, BonePart::Distal));
  for (const BoneId bone : kAllBones) {
    if (static_cast<int>(bone) != label) continue;
    const bool proximal = bone == BoneId::Scaphoid && broken_scaphoid;
    return std::string(carpus::name_of(bone, proximal ? BonePart::Proximal : BonePart::Whole));
  }
  return {};
}

}  // namespace carpus::server

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/event_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "anatomy/bone_words.hpp"
#include "instruments/instrument.hpp"
#include "procedure/aid.hpp"
#include "session/refusal_text.hpp"

namespace carpus::session {

namespace {

using simulation::EventKind;

std::string with_mm(const std::string& what, double mm) {
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "%.1f mm", mm);
  return what + " " + number.data();
}

std::string instrument_name(std::int64_t index) {
  const auto all = instruments::catalogue();
  if (index < 0 || static_cast<std::size_t>(index) >= all.size()) return "Instrument";
  return all[static_cast<std::size_t>(index)].name;
}

/// A sentence of one event, in terms of one procedure.
/// The same where no bone may be named.
constexpr std::string_view kShaftUnderSkin =
    "The shaft lies under the skin where a hand would hold it: turn it until it comes from outside";

/// By what the event says.
constexpr std::array<const char*, 3> kRanAgainst{
    " runs against what lines the joint: turn its mouth away or let the pedal go",
    " runs against cartilage: turn its mouth away or let the pedal go",
    " runs against the scope: its lens would be cut"};

class Sentence {
 public:
  Sentence(const simulation::Event& event,
           const procedure::Procedure& procedure,
           const BodyNames& bodies)
      : event_(event), procedure_(procedure), bodies_(bodies) {}

  [[nodiscard]] std::string text() const {
    switch (event_.kind) {
      case EventKind::TouchedBone:
        return "Touched the " + bone();
      case EventKind::EnteredBone:
        return subject() + " entered the " + bone();
      case EventKind::LeftFarSide:
        return with_mm(subject() + " came out of the far side of the " + target() + " by",
                       event_.value);
      case EventKind::Withdrawn:
        return instrument_name(event_.detail) + " withdrawn";
      case EventKind::ShotTaken:
        return "Picture " + std::to_string(event_.detail);
      case EventKind::GaugeRead:
        return with_mm(is_gauge() ? "Depth gauge reads" : "The second wire stands out farther, by",
                       event_.value);
      case EventKind::Taken:
        return instrument_name(event_.detail) + " taken";
      case EventKind::PutDown:
        return instrument_name(event_.detail) + " put down";
      case EventKind::Seated:
        return with_mm("Screw level with the bone, buried", event_.value);
      case EventKind::StepCompleted:
        return "Step done: " + step(event_.detail);
      case EventKind::Undone:
        return event_.detail == 0 ? "Back to the last checkpoint"
                                  : "Back to step: " + step(event_.detail - 1);
      case EventKind::Finished:
        return event_.detail == 0 ? "Operation finished" : "Declined to operate";
      case EventKind::Refused:
        return std::string(text_of(static_cast<simulation::Refusal>(event_.detail)));
      case EventKind::WrongBone:
        return subject() + " entered the " + bone() + ", which is not to be entered";
      case EventKind::Slipped:
        return subject() + " slipped along the " + bone() + ": hold it steeper to the surface";
      case EventKind::WristStopped:
        return "The wrist goes no further: its limit, or an instrument, holds it";
      case EventKind::LiveEnded:
        return "Looked live for " + seconds() + ": picture " + std::to_string(event_.detail);
      case EventKind::WireBent:
        return "The " + bone() + " bends the wire: the wrist moved over it";
      case EventKind::WireBroke:
        return "The wire broke at the bone";
      case EventKind::ScrewStripped:
        return "The screw turns freely: its thread gave way";
      case EventKind::ShaftUnderSkin:
        return std::string(kShaftUnderSkin);
      case EventKind::Judged:
        return place() == static_cast<std::size_t>(procedure::Judgement::Displaced)
                   ? "Judged: the fracture is displaced"
                   : "Judged: the fracture is aligned";
      case EventKind::AidUsed:
        return "Aid: " + procedure::in_words(static_cast<procedure::Aid>(event_.detail));
      case EventKind::StructureStruck:
        return struck();
      case EventKind::EnteredJoint:
        return subject() + " is in the joint, by " + bodies_.portal(place());
      case EventKind::LeftJoint:
        return subject() + " came out of the joint";
      case EventKind::PointSeen:
        return "Seen: " + bodies_.tour_point(event_.detail);
      case EventKind::PointProbed:
        return "Probed: " + bodies_.tour_point(event_.detail);
      case EventKind::LooseCaught:
        return subject() + " has hold of a loose body";
      case EventKind::LooseLost:
        return "The loose body slipped from the jaws: close on its middle, draw back slowly";
      case EventKind::LooseOut:
        return "A loose body is out";
      case EventKind::ScrewProbed:
        return probed_of_screw();
      case EventKind::TissueBitten:
        return subject() + (event_.detail == 1 ? " bit cartilage: it is scuffed there"
                                               : " closed on what lines the joint");
      case EventKind::CartilagePressed:
        return subject() + " pressed on the cartilage of the " + bone() + ": it is scuffed there";
      case EventKind::CapsulePushed:
        return subject() + " pushes into the capsule across from its portal: draw it back";
      case EventKind::ShaverHarmed:
        return subject() + kRanAgainst[std::min<std::size_t>(place(), kRanAgainst.size() - 1)];
      case EventKind::SoundTissueShaved:
        return event_.detail == 1 ? "The disc's rim is cut: it must stay for the wrist to be stable"
                                  : "Sound disc came off";
      case EventKind::PressureTooHigh:
        return "The joint is under too much pressure: fluid goes into the tissue";
      case EventKind::TissueSwells:
        return "Fluid has gone into the tissue: the wrist swells";
      case EventKind::ViewClouded:
        return "The view is clouded: let fluid run through, or raise its pressure";
      case EventKind::FluidBack:
        return "Fluid comes back through the needle: it is in a joint" + from_elsewhere();
      case EventKind::NeedleStruckBone:
        return "The needle struck bone: draw it back, aim anew";
      case EventKind::SkinCut:
        return "The skin is cut" + from_elsewhere();
      case EventKind::WaySpread:
        return "Spread, down to the capsule";
      case EventKind::SheathIn:
        return with_mm("The sheath gave way into a joint, and went on by", event_.value) +
               from_elsewhere();
      case EventKind::HeldBySkin:
        return subject() + " is blunt: the skin holds it, but where it was cut wide enough";
      case EventKind::NeedleSeen:
        return "The needle is seen in the scope's picture";
      case EventKind::None:
        break;
    }
    return {};
  }

 private:
  [[nodiscard]] std::string from_elsewhere() const {
    if (event_.detail != 1) return {};
    return ", but from another side of the wrist than the portal that is asked for";
  }

  [[nodiscard]] std::string probed_of_screw() const {
    switch (static_cast<cases::ScrewSite>(event_.detail)) {
      case cases::ScrewSite::Proximal:
        return "Felt in sight: over the screw's trailing end";
      case cases::ScrewSite::Scaphocapitate:
        return "Felt in sight: the scaphocapitate side";
      case cases::ScrewSite::Stt:
        return "Felt in sight: the scaphotrapeziotrapezoid joint";
    }
    return {};
  }

  [[nodiscard]] std::string struck() const {
    const std::string& what = bodies_.structure(static_cast<std::size_t>(event_.detail));
    const auto all = instruments::catalogue();
    if (event_.instrument < all.size() && all[event_.instrument].enters_joints) {
      return subject() + " went in through the " + what +
             ": go in at the portal's mark, along its way";
    }
    if (event_.instrument < all.size() && all[event_.instrument].skin) {
      return subject() + " met the " + what + ": between them, bluntly, and no deeper than skin";
    }
    return subject() + " turned in the " + what + ": spread the way with the needle sleeve first";
  }
  [[nodiscard]] bool is_gauge() const {
    const auto all = instruments::catalogue();
    return event_.instrument >= all.size() || all[event_.instrument].is_gauge;
  }
  [[nodiscard]] std::string subject() const { return instrument_name(event_.instrument); }
  [[nodiscard]] const std::string& bone() const {
    return bodies_.words(static_cast<std::size_t>(event_.detail));
  }
  [[nodiscard]] std::size_t place() const { return static_cast<std::size_t>(event_.detail); }
  [[nodiscard]] std::string seconds() const {
    const auto tenths = static_cast<long>(event_.value * 10 + 0.5);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
  }
  [[nodiscard]] std::string target() const { return std::string(words_of(procedure_.target)); }
  [[nodiscard]] std::string step(std::int32_t place) const {
    const auto index = static_cast<std::size_t>(place);
    return index < procedure_.steps.size() ? procedure_.steps[index].title : std::string("?");
  }

  const simulation::Event& event_;
  const procedure::Procedure& procedure_;
  const BodyNames& bodies_;
};

/// What is felt of it, without a name; empty where nothing is.
std::string_view felt(EventKind kind) {
  switch (kind) {
    case EventKind::TouchedBone:
      return "Touches bone";
    case EventKind::EnteredBone:
      return "The tip bites into bone";
    case EventKind::Slipped:
      return "The tip slips along bone: hold it steeper to the surface";
    case EventKind::WireBent:
      return "Something bends the wire: the wrist moved over it";
    case EventKind::CartilagePressed:
      return "Pressed hard on cartilage: it is scuffed there";
    case EventKind::CapsulePushed:
      return "Pushes into the capsule across from the portal: draw it back";
    default:
      return {};
  }
}

constexpr std::string_view kScrewProbed = "screw_probed";  // its number is apart from the others
constexpr std::array<std::string_view, 43> kNames{"none",
                                                  "touched_bone",
                                                  "entered_bone",
                                                  "left_far_side",
                                                  "withdrawn",
                                                  "shot_taken",
                                                  "gauge_read",
                                                  "taken",
                                                  "put_down",
                                                  "seated",
                                                  "step_completed",
                                                  "undone",
                                                  "finished",
                                                  "refused",
                                                  "wrong_bone",
                                                  "slipped",
                                                  "wrist_stopped",
                                                  "live_ended",
                                                  "wire_bent",
                                                  "wire_broke",
                                                  "screw_stripped",
                                                  "aid_used",
                                                  "structure_struck",
                                                  "entered_joint",
                                                  "left_joint",
                                                  "point_seen",
                                                  "point_probed",
                                                  "judged",
                                                  "shaft_under_skin",
                                                  "loose_caught",
                                                  "loose_lost",
                                                  "loose_out",
                                                  "tissue_bitten",
                                                  "shaver_harmed",
                                                  "sound_tissue_shaved",
                                                  "cartilage_pressed",
                                                  "capsule_pushed",
                                                  "none",
                                                  "none",
                                                  "none",
                                                  "pressure_too_high",
                                                  "tissue_swells",
                                                  "view_clouded"};

/// None where it is the name of no kind.
EventKind kind_of(std::string_view name) noexcept {
  if (name == kScrewProbed) return EventKind::ScrewProbed;
  const auto it = std::find(kNames.begin(), kNames.end(), name);
  return it == kNames.end() ? EventKind::None : static_cast<EventKind>(it - kNames.begin());
}

}  // namespace

std::string_view name_of(EventKind kind) noexcept {
  if (kind == EventKind::ScrewProbed) return kScrewProbed;
  const auto index = static_cast<std::size_t>(kind);
  return index < kNames.size() ? kNames[index] : kNames[0];
}

protocol::LoggedEvent describe(const simulation::Event& event,
                               const procedure::Procedure& procedure,
                               const BodyNames& bodies) {
  return {static_cast<std::int64_t>(event.tick), std::string(name_of(event.kind)),
          Sentence(event, procedure, bodies).text()};
}

std::optional<protocol::LoggedEvent> describe_blind(const simulation::Event& event,
                                                    const procedure::Procedure& procedure,
                                                    const BodyNames& bodies) {
  return blinded(describe(event, procedure, bodies));
}

std::optional<protocol::LoggedEvent> blinded(protocol::LoggedEvent told) {
  const EventKind kind = kind_of(told.kind);
  switch (kind) {
    case EventKind::None:
    case EventKind::LeftFarSide:
    case EventKind::WrongBone:
    case EventKind::StructureStruck:
    case EventKind::TissueBitten:
    case EventKind::ShaverHarmed:
    case EventKind::SoundTissueShaved:
    case EventKind::ViewClouded:
    case EventKind::WaySpread:
    case EventKind::Seated:
    case EventKind::StepCompleted:
      return std::nullopt;
    case EventKind::TouchedBone:
    case EventKind::EnteredBone:
    case EventKind::Slipped:
    case EventKind::WireBent:
      told.text = felt(kind);
      return told;
    default:
      return told;
  }
}

}  // namespace carpus::session

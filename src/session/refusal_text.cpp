// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/refusal_text.hpp"

namespace carpus::session {

std::string_view text_of(simulation::Refusal refusal) noexcept {
  using simulation::Refusal;
  switch (refusal) {
    case Refusal::None:
      return {};
    case Refusal::Finished:
      return "The operation is finished";
    case Refusal::UnknownCommand:
      return "That is not known here";
    case Refusal::NoSuchHand:
      return "There is no such hand";
    case Refusal::ShotOutOfRange:
      return "The C-arm does not turn so far";
    case Refusal::TooManyShots:
      return "No more pictures can be taken in this exercise";
    case Refusal::NotOnTheTray:
      return "It is not on the tray";
    case Refusal::HandIsFull:
      return "What the hand holds is in bone and would not stay there: draw it back first";
    case Refusal::TooManyItems:
      return "Too many instruments are in use: put one down first";
    case Refusal::NoWireToRideOn:
      return "It goes over a wire, and no wire lies in the bone that is operated on";
    case Refusal::WireIsTaken:
      return "Something rides on the wire already";
    case Refusal::NothingInHand:
      return "The hand is empty";
    case Refusal::NothingThere:
      return "There is nothing to take hold of";
    case Refusal::SomethingRidesOnIt:
      return "Something rides on it: take that off first";
    case Refusal::NoGaugeInHand:
      return "Measured is by the depth gauge over a wire, or by a second wire held along it, its "
             "tip on "
             "the bone beside it";
    case Refusal::NothingToUndo:
      return "Nothing to undo";
    case Refusal::NoUndoWhenAssessed:
      return "In an assessed operation nothing is taken back, as with a patient";
    case Refusal::EndIsInside:
      return "That end of the wire is inside: it can be held only where it stands out of the skin";
    case Refusal::WireIsBent:
      return "The wire is bent: nothing runs over it any more. Take it out and lay another";
    case Refusal::NoAidsWhenAssessed:
      return "In an assessed operation nothing helps but the pictures and the hand";
    case Refusal::NoWayBackToStep:
      return "Too much was done since: from that step on it cannot be done again";
    case Refusal::TooLateToJudge:
      return "Bone has been entered: whether it is displaced is judged before";
    case Refusal::NoReasonToDecline:
      return "Say why: choose at least one of the reasons";
  }
  return "That is not possible now";
}

}  // namespace carpus::session

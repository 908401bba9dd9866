// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a gamepad reaches in the room.
import type { PadRoom } from "../gamepad";
import type { Actions } from "./actions";
import type { Hand } from "./hand";
import type { Panels } from "./panels";
import type { TakingPart } from "./taking_part";

const HOLDER = "gamepad";

export function padRoom(panels: Panels, hand: Hand, actions: Actions, part: TakingPart): PadRoom {
  return {
    isFree: () => part.operates && document.querySelector("dialog[open]") === null,
    moveTipBy: (right, up) => {
      if (hand.isFree()) hand.moveTipBy(right, up);
    },
    turnShaftBy: (right, up) => {
      if (hand.isFree()) hand.turnShaftBy(right, up);
    },
    hold: (holder, action) => {
      hand.hold(holder, action, performance.now());
    },
    letGo: (holder) => {
      hand.letGo(holder, performance.now());
    },
    squeeze: (share) => {
      hand.squeeze(share === undefined ? undefined : share * hand.thrust);
    },
    pedal: (down) => {
      if (down) panels.arm.pedal.press(HOLDER);
      else panels.arm.pedal.release(HOLDER);
    },
    act: (action) => {
      actions.act(action);
    },
    nextShot: () => {
      panels.arm.shootNext();
    },
  };
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a gamepad reaches in the room.
import type { PadRoom } from "../gamepad";
import type { Actions } from "./actions";
import { drivenBy } from "./driven_by";
import type { Hand } from "./hand";
import { goThroughDialog } from "./pad_dialog";
import type { Panels } from "./panels";
import type { TakingPart } from "./taking_part";

function pluggedText(on: boolean, wasDriving: boolean): string {
  if (on) return "Gamepad: sticks move and turn, right trigger drives, left reverses. ? shows all.";
  return wasDriving
    ? "The gamepad is gone: the driver is off. Plug it in again, or go on by mouse and keys."
    : "The gamepad is gone: go on by mouse and keys.";
}

export function padRoom(panels: Panels, hand: Hand, actions: Actions, part: TakingPart): PadRoom {
  return {
    ...drivenBy("gamepad", panels, hand, part),
    moveTipBy: (right, up) => {
      if (hand.isFree()) hand.moveTipBy(right, up);
    },
    turnShaftBy: (right, up) => {
      if (hand.isFree()) hand.turnShaftBy(right, up);
    },
    act: (action) => {
      actions.act(action);
    },
    plugged: (on, wasDriving) => {
      panels.firstTouch.useGamepad(on);
      panels.top.showGamepad(on);
      panels.notice.say(pluggedText(on, wasDriving));
    },
    goThroughDialog,
    nextShot: () => {
      panels.arm.shootNext();
    },
  };
}

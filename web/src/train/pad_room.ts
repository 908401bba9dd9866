// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a gamepad reaches in the room.
import type { PadRoom } from "../gamepad";
import { PadAtScope, type ScopeDesk } from "../scope";
import type { Actions } from "./actions";
import { drivenBy } from "./driven_by";
import type { Hand } from "./hand";
import { goThroughDialog } from "./pad_dialog";
import type { Panels } from "./panels";
import type { TakingPart } from "./taking_part";

function pluggedText(on: boolean, wasDriving: boolean, isAtScope: boolean): string {
  if (on && isAtScope)
    return "Gamepad: it leads the hand that mouse and keys do not. The left stick leans, LB / RB draw back and go in. ? shows all.";
  if (on) return "Gamepad: sticks move and turn, right trigger drives, left reverses. ? shows all.";
  return wasDriving
    ? "The gamepad is gone: the driver is off. Plug it in again, or go on by mouse and keys."
    : "The gamepad is gone: go on by mouse and keys.";
}

export function padRoom(
  panels: Panels,
  hand: Hand,
  actions: Actions,
  part: TakingPart,
  scope: ScopeDesk,
): PadRoom {
  const driven = drivenBy("gamepad", panels, hand, part);
  const atScope = new PadAtScope(scope.second, (steps) => {
    scope.turnFocus(steps);
  });
  return {
    ...driven,
    moveTipBy: (right, up) => {
      if (scope.isOn) atScope.moveTipBy(right, up);
      else if (hand.isFree()) hand.moveTipBy(right, up);
    },
    turnShaftBy: (right, up) => {
      if (scope.isOn) atScope.turnShaftBy(right, up);
      else if (hand.isFree()) hand.turnShaftBy(right, up);
    },
    hold: (holder, action) => {
      if (scope.isOn) atScope.hold(holder, action);
      else driven.hold(holder, action);
    },
    letGo: (holder) => {
      atScope.letGo(holder);
      driven.letGo(holder);
    },
    act: (action) => {
      if (!scope.isOn || atScope.act(action)) actions.act(action);
    },
    plugged: (on, wasDriving) => {
      panels.firstTouch.useGamepad(on);
      panels.top.showGamepad(on);
      panels.notice.say(pluggedText(on, wasDriving, scope.isOn));
    },
    goThroughDialog,
    nextShot: () => {
      panels.arm.shootNext();
    },
  };
}

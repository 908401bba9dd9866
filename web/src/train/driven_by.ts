// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What gamepad and headset have in common: their triggers hold the driver and the pedal.
import type { HeldAction } from "../operation";
import type { Hand } from "./hand";
import type { Panels } from "./panels";
import type { TakingPart } from "./taking_part";

export interface Driven {
  /** Whether the hand may be moved now: one operates, and no dialog is open. */
  isFree(): boolean;
  hold(holder: string, action: HeldAction): void;
  letGo(holder: string): void;
  /** @param share  of the push that is set; undefined once the trigger is let go */
  squeeze(share: number | undefined): void;
  pedal(down: boolean): void;
}

/** @param who  holds the pedal: others may hold it too */
export function drivenBy(who: string, panels: Panels, hand: Hand, part: TakingPart): Driven {
  return {
    isFree: () => part.operates && document.querySelector("dialog[open]") === null,
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
      if (down) panels.arm.pedal.press(who);
      else panels.arm.pedal.release(who);
    },
  };
}

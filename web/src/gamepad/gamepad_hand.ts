// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The first gamepad of the standard mapping, asked once a frame, moves the hand.
import type { HeldAction, OnceAction } from "../operation";
import {
  dialogStep,
  DRIVES,
  holdsLayer,
  padWish,
  type DialogStep,
  type PadState,
  type PadWish,
} from "./pad_model";

/** After a pause nothing jumps [s]. */
const LONGEST_FRAME_S = 0.1;

export interface PadRoom {
  /** Whether the hand may be moved now: no dialog is open. */
  isFree(): boolean;
  moveTipBy(right: number, up: number): void;
  turnShaftBy(right: number, up: number): void;
  hold(holder: string, action: HeldAction): void;
  letGo(holder: string): void;
  /** @param share  of the push that is set; undefined once the trigger is let go */
  squeeze(share: number | undefined): void;
  pedal(down: boolean): void;
  act(action: OnceAction): void;
  /** Through the dialog that is open, if one is. */
  goThroughDialog(step: DialogStep): void;
  /** Takes the picture of the next named view. */
  nextShot(): void;
  /** One was plugged in, or is gone. @param wasDriving  its trigger was pressed then */
  plugged(on: boolean, wasDriving: boolean): void;
}

export class GamepadHand {
  private before: PadState | undefined;
  private lastMs = 0;
  private held: ReadonlySet<string> = new Set();
  private pedalIsDown = false;
  private isPlugged = false;
  /** Back was held for something else than undo. */
  private usedLayer = false;

  constructor(private readonly room: PadRoom) {}

  get isConnected(): boolean {
    return this.isPlugged;
  }

  frame(nowMs: number): void {
    const pad = standardPad();
    if ((pad !== undefined) !== this.isPlugged) this.plug(pad !== undefined);
    const seconds = Math.min(LONGEST_FRAME_S, (nowMs - this.lastMs) / 1000);
    this.lastMs = nowMs;
    if (pad === undefined || !this.room.isFree()) {
      this.rest();
      const step = pad && dialogStep(pad, this.before);
      if (step !== undefined) this.room.goThroughDialog(step);
      this.usedLayer = true;
      this.before = pad;
      return;
    }
    const wish = padWish(pad, this.before);
    this.useLayer(pad, wish);
    this.before = pad;
    const { tip, shaft } = wish;
    if (tip.right !== 0 || tip.up !== 0) this.room.moveTipBy(tip.right * seconds, tip.up * seconds);
    if (shaft.right !== 0 || shaft.up !== 0)
      this.room.turnShaftBy(shaft.right * seconds, shaft.up * seconds);
    this.room.squeeze(wish.held.has("pad drive") ? wish.squeeze : undefined);
    this.hold(wish);
    for (const action of wish.once) {
      if (action.kind === "next_shot") this.room.nextShot();
      else this.room.act(action);
    }
  }

  /** Back by itself, let go of, is undo. */
  private useLayer(pad: PadState, wish: PadWish): void {
    const wasHeld = this.before !== undefined && holdsLayer(this.before);
    const isHeld = holdsLayer(pad);
    if (isHeld && !wasHeld) this.usedLayer = false;
    if (wish.usesLayer) this.usedLayer = true;
    if (wasHeld && !isHeld && !this.usedLayer) this.room.act({ kind: "undo" });
  }

  /** What a pad held that is gone is let go before anything is said. */
  private plug(on: boolean): void {
    const wasDriving = [...this.held].some((holder) => DRIVES.includes(holder));
    if (!on) this.rest();
    this.isPlugged = on;
    this.room.plugged(on, wasDriving);
  }

  private hold({ held, pedal }: PadWish): void {
    for (const holder of this.held) if (!held.has(holder)) this.room.letGo(holder);
    for (const [holder, action] of held) if (!this.held.has(holder)) this.room.hold(holder, action);
    this.held = new Set(held.keys());
    if (pedal !== this.pedalIsDown) this.room.pedal(pedal);
    this.pedalIsDown = pedal;
  }

  private rest(): void {
    if (this.held.size > 0) this.room.squeeze(undefined);
    for (const holder of this.held) this.room.letGo(holder);
    this.held = new Set();
    if (this.pedalIsDown) this.room.pedal(false);
    this.pedalIsDown = false;
  }
}

/** A copy: the browser's own object may change under the reader. */
function standardPad(): PadState | undefined {
  for (const pad of navigator.getGamepads()) {
    if (pad?.connected !== true || pad.mapping !== "standard") continue;
    const buttons = pad.buttons.map(({ value, pressed }) => ({ value, pressed }));
    return { axes: [...pad.axes], buttons };
  }
  return undefined;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What two controllers of the mapping "xr-standard" ask for: one is the instrument, the other holds the
// table, the pedal, the clock. Pure: the state of one moment and of that before.
import type { HeldAction, OnceAction } from "../operation";

/** Of the browser's Gamepad. */
export interface ControllerState {
  readonly axes: readonly number[];
  readonly buttons: readonly { readonly value: number; readonly pressed: boolean }[];
}

export type HeadsetOnce =
  | OnceAction
  | { readonly kind: "next_shot" }
  /** The next instrument of the tray is chosen; "take" takes it. */
  | { readonly kind: "choose"; readonly by: 1 | -1 }
  | { readonly kind: "take" };

export interface InstrumentWish {
  readonly held: ReadonlyMap<string, HeldAction>;
  /** How deep the trigger is pressed beyond its play, 0 to 1. */
  readonly squeeze: number;
  readonly once: readonly HeadsetOnce[];
}

export interface TableWish {
  readonly pedal: boolean;
  /** Whether it holds the table and carries it. */
  readonly carries: boolean;
  /** -1 to 1: turns it, makes it larger. */
  readonly turn: number;
  readonly grow: number;
  readonly once: readonly HeadsetOnce[];
}

/** Numbers of the mapping [webxr_gamepads]. */
const TRIGGER = 0;
const SQUEEZE = 1;
const STICK = 3;
const LOWER = 4;
const UPPER = 5;
const STICK_X = 2;
const STICK_Y = 3;

/** A worn stick rests as far off its middle as this; a trigger is pressed from here. */
const DEAD_ZONE = 0.2;
const TRIGGER_FROM = 0.08;
/** A stick that is flicked beyond this chooses. */
const FLICK = 0.7;

const at = (pad: ControllerState | undefined, axis: number): number => pad?.axes[axis] ?? 0;
const isDown = (pad: ControllerState | undefined, button: number): boolean =>
  pad?.buttons[button]?.pressed ?? false;
const value = (pad: ControllerState, button: number): number => pad.buttons[button]?.value ?? 0;

type OnButton = readonly (readonly [button: number, action: HeadsetOnce])[];

function pressed(
  pad: ControllerState,
  before: ControllerState | undefined,
  on: OnButton,
): HeadsetOnce[] {
  return on
    .filter(([button]) => isDown(pad, button) && !isDown(before, button))
    .map(([, action]) => action);
}

const INSTRUMENT_ONCE: OnButton = [
  [STICK, { kind: "take" }],
  [LOWER, { kind: "next_shot" }],
  [UPPER, { kind: "pick_up" }],
];
const TABLE_ONCE: OnButton = [
  [STICK, { kind: "hint" }],
  [LOWER, { kind: "free_shot" }],
  [UPPER, { kind: "pause" }],
];

export function instrumentWish(
  pad: ControllerState,
  before: ControllerState | undefined,
): InstrumentWish {
  const held = new Map<string, HeldAction>();
  // Whoever presses both means to come back.
  if (value(pad, SQUEEZE) > 0.5) held.set("headset reverse", { kind: "drive", driver: "reverse" });
  else if (value(pad, TRIGGER) > TRIGGER_FROM)
    held.set("headset drive", { kind: "drive", driver: "forward" });
  const once = pressed(pad, before, INSTRUMENT_ONCE);
  const flick = at(pad, STICK_X);
  if (Math.abs(flick) > FLICK && Math.abs(at(before, STICK_X)) <= FLICK)
    once.push({ kind: "choose", by: flick > 0 ? 1 : -1 });
  const beyond = (value(pad, TRIGGER) - TRIGGER_FROM) / (1 - TRIGGER_FROM);
  return { held, squeeze: Math.min(1, Math.max(0, beyond)), once };
}

function stick(pad: ControllerState, axis: number): number {
  const raw = at(pad, axis);
  const beyond = (Math.abs(raw) - DEAD_ZONE) / (1 - DEAD_ZONE);
  return beyond > 0 ? Math.sign(raw) * Math.min(1, beyond) : 0;
}

export function tableWish(pad: ControllerState, before: ControllerState | undefined): TableWish {
  const turn = stick(pad, STICK_X);
  const grow = -stick(pad, STICK_Y);
  const isTurn = Math.abs(turn) > Math.abs(grow);
  return {
    pedal: value(pad, TRIGGER) > 0.5,
    carries: value(pad, SQUEEZE) > 0.5,
    turn: isTurn ? turn : 0,
    grow: isTurn ? 0 : grow + 0,
    once: pressed(pad, before, TABLE_ONCE),
  };
}

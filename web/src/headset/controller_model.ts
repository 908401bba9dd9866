// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What two controllers of the mapping "xr-standard" ask for: one is the instrument, the other holds the
// table, the pedal, the clock, and the wrist that lies there. Pure: the state of one moment and of that before.
import type { HeldAction, OnceAction, WristAxis } from "../operation";

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
  /** The same grip, and stick or buttons: moves the wrist instead. */
  readonly wrist: ReadonlyMap<string, HeldAction>;
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
const HOLDING_ONCE: OnButton = [[STICK, { kind: "hint" }]];
const TABLE_ONCE: OnButton = [
  ...HOLDING_ONCE,
  [LOWER, { kind: "free_shot" }],
  [UPPER, { kind: "pause" }],
];

/** From half its way on a stick moves the wrist, as a key does. */
const WRIST_FROM = 0.5;

/** Down flexes, sideways deviates; the upper button pronates, the lower one supinates. */
function wristHeld(pad: ControllerState): ReadonlyMap<string, HeldAction> {
  const button = (which: number): number => (isDown(pad, which) ? 1 : 0);
  const ways: readonly (readonly [axis: WristAxis, way: number])[] = [
    ["flexion_deg", at(pad, STICK_Y)],
    ["radial_deviation_deg", at(pad, STICK_X)],
    ["pronation_deg", button(UPPER) - button(LOWER)],
  ];
  return new Map(
    ways
      .filter(([, way]) => Math.abs(way) > WRIST_FROM)
      .map(([axis, way]): readonly [string, HeldAction] => {
        const sign = way > 0 ? 1 : -1;
        return [`headset ${axis} ${sign}`, { kind: "move_wrist", axis, sign }];
      }),
  );
}

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
  const holds = value(pad, SQUEEZE) > 0.5;
  const wrist = holds ? wristHeld(pad) : new Map<string, HeldAction>();
  const turn = holds ? 0 : stick(pad, STICK_X);
  const grow = holds ? 0 : -stick(pad, STICK_Y);
  const isTurn = Math.abs(turn) > Math.abs(grow);
  return {
    pedal: value(pad, TRIGGER) > 0.5,
    carries: holds && wrist.size === 0,
    wrist,
    turn: isTurn ? turn : 0,
    grow: isTurn ? 0 : grow + 0,
    once: pressed(pad, before, holds ? HOLDING_ONCE : TABLE_ONCE),
  };
}

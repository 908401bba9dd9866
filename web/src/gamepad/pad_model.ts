// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a gamepad of the standard mapping asks for: sticks move the tip and turn the shaft, triggers drive
// and reverse, the rest are buttons; while Back is held they are others: the wrist, tray and gauge, what ends it.
// Pure: the state of one moment and of that before.
import type { HeldAction, OnceAction, WristAxis } from "../operation";

/** Of the browser's Gamepad. */
export interface PadState {
  readonly axes: readonly number[];
  readonly buttons: readonly { readonly value: number; readonly pressed: boolean }[];
}

export interface Way {
  readonly right: number;
  readonly up: number;
}

export interface PadWish {
  /** On the screen [mm/s]. */
  readonly tip: Way;
  /** Of the shaft's tail on the screen [rad/s]. */
  readonly shaft: Way;
  /** What its held buttons do, by name. */
  readonly held: ReadonlyMap<string, HeldAction>;
  /** How deep the drive's trigger is pressed, 0 to 1. */
  readonly squeeze: number;
  readonly pedal: boolean;
  /** What went down since the moment before. */
  readonly once: readonly (OnceAction | { readonly kind: "next_shot" })[];
  /** Back is held, and something that goes with it. */
  readonly usesLayer: boolean;
}

/** Through an open dialog. */
export type DialogStep = "next" | "previous" | "more" | "less" | "choose" | "close";

/** A worn stick rests as far off its middle as this; a trigger is pressed from here. */
const DEAD_ZONE = 0.15;
const TRIGGER_FROM = 0.08;
/** Names under which the triggers are held. */
export const DRIVES: readonly string[] = ["pad drive", "pad reverse"];

const TIP_MM_PER_S = 30;
const SHAFT_RAD_PER_S = (70 * Math.PI) / 180;

/** The standard mapping's numbers. */
const DRIVE = 7;
const REVERSE = 6;
const PEDAL = 2;
const LAYER = 8;
const HELD: readonly (readonly [button: number, action: HeldAction])[] = [
  [4, { kind: "approach", closer: false }],
  [5, { kind: "approach", closer: true }],
  [12, { kind: "orbit", to: "up" }],
  [13, { kind: "orbit", to: "down" }],
  [14, { kind: "orbit", to: "left" }],
  [15, { kind: "orbit", to: "right" }],
];
const ONCE: readonly (readonly [button: number, action: PadWish["once"][number]])[] = [
  [0, { kind: "free_shot" }],
  [1, { kind: "aim_along_sight" }],
  [3, { kind: "next_shot" }],
  [9, { kind: "pause" }],
  [10, { kind: "switch_hand" }],
  [11, { kind: "camera" }],
];

const ONCE_IN_LAYER: readonly (readonly [button: number, action: OnceAction])[] = [
  [0, { kind: "measure" }],
  [1, { kind: "put_down" }],
  [2, { kind: "tray" }],
  [3, { kind: "pick_up" }],
  [4, { kind: "pick_up_far_end" }],
  [9, { kind: "finish" }],
  [14, { kind: "judge", displaced: false }],
  [15, { kind: "judge", displaced: true }],
];
/** A stick moves the wrist from half its way on, as a key does: which axis, and to which side. */
const WRIST_FROM = 0.5;
const WRIST: readonly (readonly [stick: number, axis: WristAxis, sign: 1 | -1])[] = [
  [1, "flexion_deg", 1],
  [0, "radial_deviation_deg", 1],
  [2, "pronation_deg", 1],
];
const DIALOG: readonly (readonly [button: number, step: DialogStep])[] = [
  [0, "choose"],
  [1, "close"],
  [12, "previous"],
  [13, "next"],
  [14, "less"],
  [15, "more"],
];

/** Fine near the middle: the square of how far it is pushed beyond the dead zone. */
function stick(pad: PadState, x: number, y: number, most: number): Way {
  const [right, down] = [pad.axes[x] ?? 0, pad.axes[y] ?? 0];
  const size = Math.hypot(right, down);
  if (!(size > DEAD_ZONE)) return { right: 0, up: 0 };
  const share = Math.min(1, (size - DEAD_ZONE) / (1 - DEAD_ZONE));
  const factor = (most * share * share) / size;
  return { right: right * factor, up: down === 0 ? 0 : -down * factor };
}

function isDown(of: PadState | undefined, button: number): boolean {
  return of?.buttons[button]?.pressed ?? false;
}

/** Of these, what belongs to a button that went down since. */
function wentDown<Action>(
  table: readonly (readonly [button: number, action: Action])[],
  pad: PadState,
  before: PadState | undefined,
): readonly Action[] {
  return table
    .filter(([button]) => isDown(pad, button) && !isDown(before, button))
    .map(([, action]) => action);
}

export function holdsLayer(pad: PadState): boolean {
  return isDown(pad, LAYER);
}

/** What an open dialog is asked for. */
export function dialogStep(pad: PadState, before: PadState | undefined): DialogStep | undefined {
  return wentDown(DIALOG, pad, before)[0];
}

const NO_WAY: Way = { right: 0, up: 0 };

function layerWish(pad: PadState, before: PadState | undefined): PadWish {
  const held = new Map<string, HeldAction>();
  for (const [axis, of, sign] of WRIST) {
    const value = pad.axes[axis] ?? 0;
    if (Math.abs(value) < WRIST_FROM) continue;
    const way = value > 0 ? sign : sign === 1 ? -1 : 1;
    held.set(`pad wrist ${of} ${way}`, { kind: "move_wrist", axis: of, sign: way });
  }
  const once = wentDown(ONCE_IN_LAYER, pad, before);
  const usesLayer = held.size > 0 || once.length > 0;
  return { tip: NO_WAY, shaft: NO_WAY, held, squeeze: 0, pedal: false, once, usesLayer };
}

export function padWish(pad: PadState, before: PadState | undefined): PadWish {
  if (holdsLayer(pad)) return layerWish(pad, before);
  const value = (button: number): number => pad.buttons[button]?.value ?? 0;
  const held = new Map<string, HeldAction>();
  for (const [button, action] of HELD) {
    if (isDown(pad, button)) held.set(`pad ${button}`, action);
  }
  // Whoever presses both means to come back.
  if (value(REVERSE) > TRIGGER_FROM) held.set("pad reverse", { kind: "drive", driver: "reverse" });
  else if (value(DRIVE) > TRIGGER_FROM) held.set("pad drive", { kind: "drive", driver: "forward" });
  return {
    tip: stick(pad, 0, 1, TIP_MM_PER_S),
    shaft: stick(pad, 2, 3, SHAFT_RAD_PER_S),
    held,
    squeeze: Math.min(1, Math.max(0, (value(DRIVE) - TRIGGER_FROM) / (1 - TRIGGER_FROM))),
    pedal: isDown(pad, PEDAL),
    once: wentDown(ONCE, pad, before),
    usesLayer: false,
  };
}

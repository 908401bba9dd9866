// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every key of Train, once: the page acts by this table and the help shows it. Letters go by what
// the key says, so that they are where the help says on every keyboard; digits and brackets go by
// where the key is, since on many keyboards they need Shift.
import type { WristPose } from "../protocol";

export type Direction = "up" | "down" | "left" | "right";

/** Done while the key is down. */
export type HeldAction =
  | { readonly kind: "move_tip"; readonly to: Direction }
  | { readonly kind: "turn_shaft"; readonly to: Direction }
  | { readonly kind: "orbit"; readonly to: Direction }
  | { readonly kind: "approach"; readonly closer: boolean }
  | { readonly kind: "move_wrist"; readonly axis: WristAxis; readonly sign: 1 | -1 }
  | { readonly kind: "drive"; readonly driver: "forward" | "reverse" };

/** What of the wrist is moved: a field of the protocol's wrist_pose. */
export type WristAxis = keyof WristPose;

/** Done once, when the key goes down. */
export type OnceAction =
  | { readonly kind: "shot"; readonly view: number }
  | { readonly kind: "turn_c_arm"; readonly rotationDeg: number; readonly tiltDeg: number }
  | { readonly kind: "change_thrust"; readonly byN: number }
  | { readonly kind: "choose_screw"; readonly by: number }
  | {
      readonly kind:
        | "free_shot"
        | "invert"
        | "measure"
        | "tray"
        | "put_down"
        | "pick_up"
        | "switch_hand"
        | "undo"
        | "finish"
        | "pause"
        | "camera"
        | "skin"
        | "labels"
        | "help"
        | "full_screen"
        | "zoom_in"
        | "zoom_out";
    };

export interface KeyPress {
  readonly key: string;
  readonly code: string;
  readonly shift: boolean;
  readonly ctrl: boolean;
}

const ARROWS: Readonly<Record<string, Direction>> = {
  ArrowUp: "up",
  ArrowDown: "down",
  ArrowLeft: "left",
  ArrowRight: "right",
};

const LETTERS: Readonly<Record<string, OnceAction>> = {
  x: { kind: "free_shot" },
  i: { kind: "invert" },
  m: { kind: "measure" },
  c: { kind: "tray" },
  q: { kind: "put_down" },
  g: { kind: "pick_up" },
  h: { kind: "switch_hand" },
  z: { kind: "undo" },
  f: { kind: "finish" },
  p: { kind: "pause" },
  v: { kind: "camera" },
  t: { kind: "skin" },
  l: { kind: "labels" },
  "?": { kind: "help" },
  "+": { kind: "zoom_in" },
  "=": { kind: "zoom_in" },
  "-": { kind: "zoom_out" },
  _: { kind: "zoom_out" },
};

/** Two keys beside each other for each way in which the wrist moves: first more, then less. */
export const WRIST_KEYS: Readonly<Record<WristAxis, readonly [more: string, less: string]>> = {
  flexion_deg: ["j", "u"],
  radial_deviation_deg: ["k", "o"],
  pronation_deg: ["n", "b"],
  traction_n: ["w", "s"],
};

/** Push of the hand per key press [N]. */
export const THRUST_STEP_N = 5;
export const MAX_THRUST_N = 60;
/** The C-arm turns by this much per key press [deg]. */
export const C_ARM_STEP_DEG = 5;

/** Whether this key is the C-arm's foot pedal. */
export function isPedal(press: KeyPress): boolean {
  return !press.ctrl && press.key.toLowerCase() === "e";
}

/** What this key does while it is held, if anything. */
export function heldAction(press: KeyPress): HeldAction | undefined {
  const to = ARROWS[press.key];
  if (to !== undefined) {
    if (press.ctrl) return { kind: "orbit", to };
    return { kind: press.shift ? "turn_shaft" : "move_tip", to };
  }
  if (press.ctrl) return undefined;
  if (press.code === "Space") return { kind: "drive", driver: "forward" };
  switch (press.key.toLowerCase()) {
    case "r":
      return { kind: "drive", driver: "reverse" };
    case "a":
      return { kind: "approach", closer: true };
    case "d":
      return { kind: "approach", closer: false };
    default:
      return wristAction(press.key.toLowerCase());
  }
}

function wristAction(key: string): HeldAction | undefined {
  for (const axis of Object.keys(WRIST_KEYS) as WristAxis[]) {
    const at = WRIST_KEYS[axis].indexOf(key);
    if (at >= 0) return { kind: "move_wrist", axis, sign: at === 0 ? 1 : -1 };
  }
  return undefined;
}

/** What this key does once, if anything. */
export function onceAction(press: KeyPress): OnceAction | undefined {
  if (press.ctrl) return undefined;
  const digit = /^(?:Digit|Numpad)([1-6])$/.exec(press.code)?.[1];
  if (digit !== undefined) return { kind: "shot", view: Number(digit) - 1 };
  switch (press.code) {
    case "BracketLeft":
      return { kind: "change_thrust", byN: -THRUST_STEP_N };
    case "BracketRight":
      return { kind: "change_thrust", byN: THRUST_STEP_N };
    case "Comma":
    case "Period": {
      const step = press.code === "Comma" ? -C_ARM_STEP_DEG : C_ARM_STEP_DEG;
      return press.shift
        ? { kind: "turn_c_arm", rotationDeg: 0, tiltDeg: step }
        : { kind: "turn_c_arm", rotationDeg: step, tiltDeg: 0 };
    }
    case "PageUp":
      return { kind: "choose_screw", by: -1 };
    case "PageDown":
      return { kind: "choose_screw", by: 1 };
    default:
      return LETTERS[press.key.toLowerCase()];
  }
}

export interface HelpLine {
  readonly keys: string;
  readonly text: string;
}
export interface HelpGroup {
  readonly title: string;
  readonly lines: readonly HelpLine[];
}

/** What the help overlay shows. */
export const HELP: readonly HelpGroup[] = [
  {
    title: "Hands",
    lines: [
      { keys: "Left drag", text: "tip follows the pointer over the bone" },
      { keys: "Shift + left drag", text: "turn the shaft about its tip" },
      { keys: "Arrows", text: "tip by 0.1 mm; hold to go on" },
      { keys: "Shift + arrows", text: "shaft by 0.5°; hold to go on" },
      { keys: "A / D", text: "advance to the bone / draw back, 0.1 mm" },
      { keys: "H", text: "move the other hand; this one stays where it is" },
    ],
  },
  {
    title: "Drive",
    lines: [
      { keys: "Space", text: "hold: drive forward" },
      { keys: "R", text: "hold: reverse" },
      { keys: "[ / ]", text: "push less / more, 5 N" },
    ],
  },
  {
    title: "Instruments",
    lines: [
      { keys: "C", text: "tray: arrows and Enter take" },
      { keys: "Q", text: "put down what the hand holds" },
      { keys: "G", text: "take hold of what lies in bone" },
      { keys: "M", text: "other hand: gauge over the wire, read, put down" },
      { keys: "Page up / down", text: "next shorter / longer screw" },
    ],
  },
  {
    title: "Wrist",
    lines: [
      { keys: "J / U", text: "flex / extend, 1°; hold to go on" },
      { keys: "K / O", text: "bend to the thumb / to the little finger" },
      { keys: "N / B", text: "pronate / supinate" },
      { keys: "W / S", text: "pull more / less at the fingers" },
    ],
  },
  {
    title: "C-arm",
    lines: [
      { keys: "1 … 6", text: "picture of the view on that button" },
      { keys: ", / .", text: "turn the C-arm by 5°; with Shift: tilt" },
      { keys: "X", text: "picture from where the C-arm stands" },
      { keys: "E", text: "hold: live pictures, 10 a second" },
      { keys: "I", text: "invert black and white" },
    ],
  },
  {
    title: "Look",
    lines: [
      { keys: "Right drag, Ctrl + arrows", text: "turn the view" },
      { keys: "Wheel, + / -", text: "nearer / farther" },
      { keys: "Middle drag", text: "shift the view" },
      { keys: "V", text: "next view: four sides, along the shaft" },
      { keys: "T / L", text: "skin / names of the bones" },
    ],
  },
  {
    title: "Exercise",
    lines: [
      { keys: "Z", text: "undo: back to the last checkpoint" },
      { keys: "F", text: "finish (asks first)" },
      { keys: "P", text: "pause" },
      { keys: "?", text: "this help" },
      { keys: "Esc", text: "close what is open" },
    ],
  },
];

/** Keys of what a step's `actions` name: of the protocol's action_id, or what the page does itself. */
const KEYS_OF: Readonly<Record<string, string>> = {
  move_tip: "Left drag, arrows",
  turn_shaft: "Shift + drag, Shift + arrows",
  approach: "A / D",
  drive: "Hold Space",
  reverse: "R reverses",
  move_wrist: "J U, K O, N B, W S",
  switch_hand: "H",
  shot: "1 … 6, X, hold E",
  take_shot: "1 … 6, X, hold E",
  take: "C",
  pick_up: "G",
  put_down: "Q",
  read_gauge: "M",
  undo: "Z",
  finish: "F",
};

/** Each action's keys; one that the page has no key for is passed over. */
export function keysOf(actions: readonly string[]): readonly string[] {
  return [...new Set(actions.flatMap((action) => KEYS_OF[action] ?? []))];
}

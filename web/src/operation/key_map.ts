// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every key of Train, once: the page acts by this table and the help shows it. Letters go by what
// the key says, so that they are where the help says on every keyboard; digits and brackets go by
// where the key is, since on many keyboards they need Shift.

export type Direction = "up" | "down" | "left" | "right";

/** Done while the key is down. */
export type HeldAction =
  | { readonly kind: "move_tip"; readonly to: Direction }
  | { readonly kind: "turn_shaft"; readonly to: Direction }
  | { readonly kind: "orbit"; readonly to: Direction }
  | { readonly kind: "approach"; readonly closer: boolean }
  | { readonly kind: "drive"; readonly driver: "forward" | "reverse" };

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
        | "screws"
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
  c: { kind: "screws" },
  z: { kind: "undo" },
  f: { kind: "finish" },
  p: { kind: "pause" },
  v: { kind: "camera" },
  t: { kind: "skin" },
  l: { kind: "labels" },
  h: { kind: "help" },
  "?": { kind: "help" },
  "+": { kind: "zoom_in" },
  "=": { kind: "zoom_in" },
  "-": { kind: "zoom_out" },
  _: { kind: "zoom_out" },
};

/** Push of the hand per key press [N]. */
export const THRUST_STEP_N = 5;
export const MAX_THRUST_N = 60;
/** The C-arm turns by this much per key press [deg]. */
export const C_ARM_STEP_DEG = 5;

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
      return undefined;
  }
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
    title: "Hold the wire",
    lines: [
      { keys: "Left drag", text: "tip follows the pointer over the bone" },
      { keys: "Shift + left drag", text: "turn the shaft about its tip" },
      { keys: "Arrows", text: "tip by 0.1 mm; hold to go on" },
      { keys: "Shift + arrows", text: "shaft by 0.5°; hold to go on" },
      { keys: "A / D", text: "advance to the bone / draw back, 0.1 mm" },
    ],
  },
  {
    title: "Drive",
    lines: [
      { keys: "Space", text: "hold: drive wire or screw forward" },
      { keys: "R", text: "hold: reverse" },
      { keys: "Let go", text: "with the screw seated: driver and wire come out" },
      { keys: "[ / ]", text: "push less / more, 5 N" },
    ],
  },
  {
    title: "C-arm",
    lines: [
      { keys: "1 … 6", text: "picture: PA, LAT, 45P, 45S, 60P, SKY" },
      { keys: ", / .", text: "turn the C-arm by 5°; with Shift: tilt" },
      { keys: "X", text: "picture from where the C-arm stands" },
      { keys: "I", text: "invert black and white" },
    ],
  },
  {
    title: "Measure and fix",
    lines: [
      { keys: "M", text: "read the depth gauge" },
      { keys: "C", text: "list of screws; arrows and Enter choose" },
      { keys: "Page up / down", text: "next shorter / longer screw" },
      { keys: "F", text: "finish (asks first)" },
    ],
  },
  {
    title: "Look",
    lines: [
      { keys: "Right drag, Ctrl + arrows", text: "turn the view" },
      { keys: "Wheel, + / -", text: "nearer / farther" },
      { keys: "Middle drag", text: "shift the view" },
      { keys: "V", text: "next view: dorsal, sides, volar, along the wire" },
      { keys: "T / L", text: "skin / names of the bones" },
    ],
  },
  {
    title: "Exercise",
    lines: [
      { keys: "Z", text: "undo: back to the last checkpoint" },
      { keys: "P", text: "pause" },
      { keys: "?", text: "this help" },
      { keys: "Esc", text: "close what is open" },
    ],
  },
];

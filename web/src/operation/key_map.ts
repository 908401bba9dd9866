// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every key of Train, once: the page acts by this table and the help shows it (key_help.ts). A key goes
// by where it is, so that each can be reached on every layout without AltGr; key_caps/ shows what is
// printed there. What has no place here goes by what it types: `?`, `+`, `-`.
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
  | { readonly kind: "judge"; readonly displaced: boolean }
  | {
      readonly kind:
        | "free_shot"
        | "invert"
        | "measure"
        | "tray"
        | "put_down"
        | "pick_up"
        | "pick_up_far_end"
        | "switch_hand"
        | "undo"
        | "finish"
        | "decline"
        | "ghost"
        | "cut"
        | "hint"
        | "voltage"
        | "dose"
        | "pause"
        | "camera"
        | "skin"
        | "labels"
        | "structures"
        | "help"
        | "full_screen"
        | "zoom_in"
        | "zoom_out"
        | "aim_along_sight"
        | "coarse"
        | "enlarge"
        | "shrink"
        | "keep_reference"
        | "save_picture"
        | "ruler"
        | "beam"
        | "sound";
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

const PLACES: Readonly<Record<string, OnceAction>> = {
  KeyX: { kind: "free_shot" },
  KeyI: { kind: "invert" },
  KeyM: { kind: "measure" },
  KeyC: { kind: "tray" },
  KeyQ: { kind: "put_down" },
  KeyG: { kind: "pick_up" },
  KeyH: { kind: "switch_hand" },
  KeyZ: { kind: "undo" },
  KeyF: { kind: "finish" },
  KeyP: { kind: "pause" },
  KeyV: { kind: "camera" },
  KeyT: { kind: "skin" },
  KeyL: { kind: "labels" },
  KeyY: { kind: "coarse" },
  Digit7: { kind: "enlarge" },
  Digit8: { kind: "keep_reference" },
  Escape: { kind: "shrink" },
  Quote: { kind: "ruler" },
  Backquote: { kind: "sound" },
  Semicolon: { kind: "beam" },
  Backslash: { kind: "save_picture" },
  Enter: { kind: "aim_along_sight" },
  Delete: { kind: "decline" },
  Home: { kind: "judge", displaced: false },
  End: { kind: "judge", displaced: true },
  F1: { kind: "help" },
  F2: { kind: "ghost" },
  F4: { kind: "cut" },
  F7: { kind: "structures" },
  F8: { kind: "hint" },
  F9: { kind: "voltage" },
  F10: { kind: "dose" },
  PageUp: { kind: "choose_screw", by: -1 },
  PageDown: { kind: "choose_screw", by: 1 },
  Equal: { kind: "zoom_in" },
  Minus: { kind: "zoom_out" },
  NumpadAdd: { kind: "zoom_in" },
  NumpadSubtract: { kind: "zoom_out" },
};

/** By what is typed, where the place says nothing. */
const TYPED: Readonly<Record<string, OnceAction>> = {
  "+": { kind: "zoom_in" },
  "-": { kind: "zoom_out" },
};

/** Two keys beside each other for each way in which the wrist moves: first more, then less. */
export const WRIST_KEYS: Readonly<Record<WristAxis, readonly [more: string, less: string]>> = {
  flexion_deg: ["KeyJ", "KeyU"],
  radial_deviation_deg: ["KeyK", "KeyO"],
  pronation_deg: ["KeyN", "KeyB"],
  traction_n: ["KeyW", "KeyS"],
};

/** Push of the hand per key press [N]. */
export const THRUST_STEP_N = 5;
export const MAX_THRUST_N = 60;
/** The C-arm turns by this much per key press [deg]. */
export const C_ARM_STEP_DEG = 5;

/** Less and more push: beside each other twice, since on some keyboards the brackets are out of the way. */
const THRUST_KEYS: Readonly<Record<string, 1 | -1>> = {
  BracketLeft: -1,
  BracketRight: 1,
  Digit9: -1,
  Digit0: 1,
};

/** Whether this key is the C-arm's foot pedal. */
export function isPedal(press: KeyPress): boolean {
  return !press.ctrl && press.code === "KeyE";
}

/** What this key does while it is held, if anything. */
export function heldAction(press: KeyPress): HeldAction | undefined {
  const to = ARROWS[press.code];
  if (to !== undefined) {
    if (press.ctrl) return { kind: "orbit", to };
    return { kind: press.shift ? "turn_shaft" : "move_tip", to };
  }
  if (press.ctrl) return undefined;
  switch (press.code) {
    case "Space":
      return { kind: "drive", driver: "forward" };
    case "KeyR":
      return { kind: "drive", driver: "reverse" };
    case "KeyA":
      return { kind: "approach", closer: true };
    case "KeyD":
      return { kind: "approach", closer: false };
    default:
      return wristAction(press.code);
  }
}

function wristAction(code: string): HeldAction | undefined {
  for (const axis of Object.keys(WRIST_KEYS) as WristAxis[]) {
    const at = WRIST_KEYS[axis].indexOf(code);
    if (at >= 0) return { kind: "move_wrist", axis, sign: at === 0 ? 1 : -1 };
  }
  return undefined;
}

/** What this key does once, if anything. */
export function onceAction(press: KeyPress): OnceAction | undefined {
  if (press.ctrl) return undefined;
  if (press.key === "?") return { kind: "help" };
  const digit = /^(?:Digit|Numpad)([1-6])$/.exec(press.code)?.[1];
  if (digit !== undefined) return { kind: "shot", view: Number(digit) - 1 };
  const thrust = THRUST_KEYS[press.code];
  if (thrust !== undefined) return { kind: "change_thrust", byN: thrust * THRUST_STEP_N };
  if (press.code === "Comma" || press.code === "Period") {
    const step = press.code === "Comma" ? -C_ARM_STEP_DEG : C_ARM_STEP_DEG;
    return press.shift
      ? { kind: "turn_c_arm", rotationDeg: 0, tiltDeg: step }
      : { kind: "turn_c_arm", rotationDeg: step, tiltDeg: 0 };
  }
  if (press.shift && press.code === "KeyG") return { kind: "pick_up_far_end" };
  return PLACES[press.code] ?? TYPED[press.key];
}

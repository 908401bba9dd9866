// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which keys lead what is in the joint: by where they are on the keyboard.
export type ScopeMotion =
  | { readonly kind: "lean"; readonly yaw: number; readonly pitch: number }
  | { readonly kind: "advance"; readonly by: number }
  | { readonly kind: "turn_shaft"; readonly by: number }
  | { readonly kind: "turn_camera"; readonly by: number }
  /** A shaver's pedal is down. */
  | { readonly kind: "run" };

export type ScopeAct =
  | "switch_hand"
  | "next_portal"
  | "panorama"
  | "level"
  | "findings"
  | "jaws"
  | "focus_nearer"
  | "focus_farther";

/** Steps of the focus ring; 0: it is something else. */
export function focusBy(act: ScopeAct): number {
  if (act === "focus_nearer") return 1;
  return act === "focus_farther" ? -1 : 0;
}

const LEANS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** While it is held. */
export function scopeMotion(code: string, shift: boolean): ScopeMotion | undefined {
  const lean = LEANS[code];
  if (lean !== undefined && !shift) return { kind: "lean", yaw: lean[0], pitch: lean[1] };
  switch (code) {
    case "KeyA":
      return { kind: "advance", by: 1 };
    case "KeyD":
      return { kind: "advance", by: -1 };
    case "Comma":
    case "ArrowLeft":
      return shift && code === "Comma"
        ? { kind: "turn_camera", by: 1 }
        : { kind: "turn_shaft", by: 1 };
    case "Period":
    case "ArrowRight":
      return shift && code === "Period"
        ? { kind: "turn_camera", by: -1 }
        : { kind: "turn_shaft", by: -1 };
    default:
      return undefined;
  }
}

/** Once. */
export function scopeAct(code: string): ScopeAct | undefined {
  switch (code) {
    case "KeyH":
      return "switch_hand";
    case "KeyG":
      return "jaws";
    case "KeyV":
      return "next_portal";
    case "Digit7":
      return "panorama";
    case "Digit8":
      return "level";
    case "Digit9":
      return "findings";
    case "BracketLeft":
      return "focus_nearer";
    case "BracketRight":
      return "focus_farther";
    default:
      return undefined;
  }
}

export const KEYS_IN_WORDS = "Arrows or a drag lean it, the wheel goes in and out.";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Under the round picture: what the keys do with traction, scope and camera, for mouse and fingers.
import { button, make, whileHeld } from "../dom";
import { keyCap, nameShortcut } from "../key_caps";
import type { ScopeAct, ScopeMotion } from "./scope_keys";

export interface ScopeControlHandlers {
  hold(holder: string, motion: ScopeMotion): void;
  letGo(holder: string): void;
  act(act: ScopeAct): void;
  /** @param by  newtons */
  pull(by: number): void;
}

const PULL_N = 5;
const TURNS: readonly (readonly [string, string, string, ScopeMotion])[] = [
  ["In", "{KeyA}", "Advances", { kind: "advance", by: 1 }],
  ["Out", "{KeyD}", "Draws back", { kind: "advance", by: -1 }],
  ["Shaft ↺", "{Comma}", "Turns the shaft: looks round", { kind: "turn_shaft", by: 1 }],
  ["Shaft ↻", "{Period}", "Turns the shaft: looks round", { kind: "turn_shaft", by: -1 }],
  ["Camera ↺", "Shift + {Comma}", "Turns the camera head", { kind: "turn_camera", by: 1 }],
  ["Camera ↻", "Shift + {Period}", "Turns the camera head", { kind: "turn_camera", by: -1 }],
];

/** What helps a beginner and is not there when one is assessed: why, in words. */
export const WHY_NO_AID = {
  panorama: "There is no panorama when you are assessed: the scope's picture alone leads.",
  level: "The horizon is yours to keep when you are assessed: turn the camera head.",
} as const;

/** @param isAssessed  its aids say so and do nothing */
export function offerScopeAids(controls: HTMLElement, isAssessed: boolean): void {
  for (const aid of ["panorama", "level"] as const) {
    const b = controls.querySelector<HTMLButtonElement>(`.scope-${aid}`);
    b?.setAttribute("aria-disabled", String(isAssessed));
    if (b !== null) b.title = isAssessed ? WHY_NO_AID[aid] : "";
  }
}

export function makeScopeControls(handlers: ScopeControlHandlers): HTMLElement {
  const act = (label: string, key: string, what: ScopeAct): HTMLButtonElement =>
    button(label, key, () => {
      handlers.act(what);
    });
  const pull = (label: string, key: string, by: number): HTMLButtonElement => {
    const b = button(label, key, () => {
      handlers.pull(by);
    });
    b.title = `${by > 0 ? "More" : "Less"} traction by ${Math.abs(by)} N; the key goes on while it is held`;
    return b;
  };
  const findings = act("Findings", "9", "findings");
  findings.classList.add("scope-findings");
  const jaws = act("Jaws", "{KeyG}", "jaws");
  jaws.classList.add("scope-jaws");
  jaws.title = "Closes the jaws, and opens them again";
  const whileDown = (
    label: string,
    keys: string,
    title: string,
    motion: ScopeMotion,
  ): HTMLButtonElement => {
    const b = make("button", { type: "button", title }, label, keyCap(keys));
    nameShortcut(b, keys);
    whileHeld(
      b,
      (holder) => {
        handlers.hold(`${label} ${holder}`, motion);
      },
      (holder) => {
        handlers.letGo(`${label} ${holder}`);
      },
    );
    return b;
  };
  const level = act("Level", "8", "level");
  level.classList.add("scope-level");
  const panorama = act("Panorama", "7", "panorama");
  panorama.classList.add("scope-panorama");
  const held = TURNS.map((turn) => whileDown(...turn));
  const pedal = whileDown("Pedal", "{KeyG}", "The shaver runs while it is held", { kind: "run" });
  pedal.classList.add("scope-pedal");
  return make(
    "div.scope-controls",
    { role: "group", "aria-label": "Scope" },
    pull("Pull less", "{KeyS}", -PULL_N),
    pull("Pull more", "{KeyW}", PULL_N),
    ...held,
    level,
    act("Other hand", "{KeyH}", "switch_hand"),
    jaws,
    pedal,
    act("Portal", "{KeyV}", "next_portal"),
    panorama,
    findings,
  );
}

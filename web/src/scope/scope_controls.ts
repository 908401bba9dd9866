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
  const held = TURNS.map((turn) => whileDown(...turn));
  const pedal = whileDown("Pedal", "{KeyG}", "The shaver runs while it is held", { kind: "run" });
  pedal.classList.add("scope-pedal");
  return make(
    "div.scope-controls",
    { role: "group", "aria-label": "Scope" },
    pull("Pull less", "{KeyS}", -PULL_N),
    pull("Pull more", "{KeyW}", PULL_N),
    ...held,
    act("Level", "8", "level"),
    act("Other hand", "{KeyH}", "switch_hand"),
    jaws,
    pedal,
    act("Portal", "{KeyV}", "next_portal"),
    act("Panorama", "7", "panorama"),
    findings,
  );
}

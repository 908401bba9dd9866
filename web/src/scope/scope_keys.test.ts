// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { focusBy, scopeAct, scopeMotion } from "./scope_keys";

describe("keys of the scope", () => {
  it("turn the shaft apart from the camera head", () => {
    expect(scopeMotion("Comma", false)).toEqual({ kind: "turn_shaft", by: 1 });
    expect(scopeMotion("Comma", true)).toEqual({ kind: "turn_camera", by: 1 });
    expect(scopeMotion("ArrowRight", true)).toEqual({ kind: "turn_shaft", by: -1 });
  });
  it("lean, advance and draw back", () => {
    expect(scopeMotion("ArrowUp", false)).toEqual({ kind: "lean", yaw: 0, pitch: 1 });
    expect(scopeMotion("KeyD", false)).toEqual({ kind: "advance", by: -1 });
    expect(scopeMotion("KeyJ", false)).toBeUndefined();
  });
  it("turn the focus ring, nearer and farther", () => {
    expect(scopeAct("BracketLeft")).toBe("focus_nearer");
    expect(scopeAct("BracketRight")).toBe("focus_farther");
    expect(focusBy("focus_nearer")).toBe(1);
    expect(focusBy("focus_farther")).toBe(-1);
    expect(focusBy("level")).toBe(0);
  });
  it("leave the other keys to the room", () => {
    expect(scopeAct("KeyH")).toBe("switch_hand");
    expect(scopeAct("Digit8")).toBe("level");
    expect(scopeAct("KeyF")).toBeUndefined();
  });
});

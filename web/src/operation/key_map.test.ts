// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys do what the help says, and no key does two things.
import { describe, expect, it } from "vitest";
import { HELP, heldAction, keysOf, onceAction, WRIST_KEYS, type KeyPress } from "./key_map";

function press(
  key: string,
  code = `Key${key.toUpperCase()}`,
  more: Partial<KeyPress> = {},
): KeyPress {
  return { key, code, shift: false, ctrl: false, ...more };
}

describe("heldAction", () => {
  it("moves, turns or orbits by the arrows as Shift and Ctrl say", () => {
    expect(heldAction(press("ArrowUp", "ArrowUp"))).toEqual({ kind: "move_tip", to: "up" });
    expect(heldAction(press("ArrowUp", "ArrowUp", { shift: true }))?.kind).toBe("turn_shaft");
    expect(heldAction(press("ArrowUp", "ArrowUp", { ctrl: true }))?.kind).toBe("orbit");
  });

  it("drives by Space and R, in capitals too", () => {
    expect(heldAction(press(" ", "Space"))).toEqual({ kind: "drive", driver: "forward" });
    expect(heldAction(press("R", "KeyR"))).toEqual({ kind: "drive", driver: "reverse" });
  });

  it("moves the wrist both ways by a pair of keys each", () => {
    for (const [axis, keys] of Object.entries(WRIST_KEYS)) {
      const signs = keys.map((key) => heldAction(press(key)));
      expect(signs).toEqual([
        { kind: "move_wrist", axis, sign: 1 },
        { kind: "move_wrist", axis, sign: -1 },
      ]);
    }
  });

  it("leaves the browser's own shortcuts alone", () => {
    expect(heldAction(press("r", "KeyR", { ctrl: true }))).toBeUndefined();
    expect(onceAction(press("p", "KeyP", { ctrl: true }))).toBeUndefined();
  });
});

describe("onceAction", () => {
  it("takes shots by the digits of any keyboard", () => {
    expect(onceAction(press("&", "Digit1"))).toEqual({ kind: "shot", view: 0 });
    expect(onceAction(press("6", "Numpad6"))).toEqual({ kind: "shot", view: 5 });
    expect(onceAction(press("7", "Digit7"))).toBeUndefined();
  });

  it("turns the C-arm by comma and full stop, tilts with Shift", () => {
    expect(onceAction(press(",", "Comma"))).toMatchObject({ rotationDeg: -5, tiltDeg: 0 });
    expect(onceAction(press(">", "Period", { shift: true }))).toMatchObject({ tiltDeg: 5 });
  });

  it("never does something once for a key that is held", () => {
    for (const code of "abcdefghijklmnopqrstuvwxyz") {
      const key = press(code);
      expect(heldAction(key) !== undefined && onceAction(key) !== undefined).toBe(false);
    }
  });
});

describe("HELP", () => {
  it("names every letter that does something", () => {
    const shown = HELP.flatMap((group) => group.lines.map((line) => line.keys)).join(" ");
    for (const letter of "abcdefghijklmnopqrstuvwxyz") {
      const does = heldAction(press(letter)) ?? onceAction(press(letter));
      if (does !== undefined) expect(shown).toMatch(new RegExp(`\\b${letter.toUpperCase()}\\b`));
    }
  });
});

describe("keysOf", () => {
  it("names the keys of a step's actions once each and passes over what it has none for", () => {
    expect(keysOf(["shot", "take_shot", "sing", "finish"])).toEqual(["1 … 6, X, hold E", "F"]);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys do what the help says, and no key does two things.
import { describe, expect, it } from "vitest";
import { HELP, keysOf } from "./key_help";
import { heldAction, onceAction, WRIST_KEYS, type KeyPress } from "./key_map";

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

  it("goes by where a key is, whatever is printed on it", () => {
    expect(heldAction(press("q", "KeyA"))).toEqual({ kind: "approach", closer: true });
    expect(onceAction(press("я", "KeyZ"))).toEqual({ kind: "undo" });
    expect(onceAction(press("ü", "BracketLeft"))).toEqual({ kind: "change_thrust", byN: -5 });
    expect(onceAction(press("à", "Digit0"))).toEqual({ kind: "change_thrust", byN: 5 });
  });

  it("drives by Space and R, in capitals too", () => {
    expect(heldAction(press(" ", "Space"))).toEqual({ kind: "drive", driver: "forward" });
    expect(heldAction(press("R", "KeyR"))).toEqual({ kind: "drive", driver: "reverse" });
  });

  it("moves the wrist both ways by a pair of keys each", () => {
    for (const [axis, keys] of Object.entries(WRIST_KEYS)) {
      const signs = keys.map((code) => heldAction(press("", code)));
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
    expect(onceAction(press("7", "Numpad7"))).toBeUndefined();
  });

  it("turns the C-arm by comma and full stop, tilts with Shift", () => {
    expect(onceAction(press(",", "Comma"))).toMatchObject({ rotationDeg: -5, tiltDeg: 0 });
    expect(onceAction(press("Home", "Home"))).toEqual({ kind: "judge", displaced: false });
    expect(onceAction(press("End", "End"))).toEqual({ kind: "judge", displaced: true });
    expect(onceAction(press(">", "Period", { shift: true }))).toMatchObject({ tiltDeg: 5 });
  });

  it("opens the help by ? wherever that is, and by F1", () => {
    for (const key of [press("?", "Slash"), press("?", "Minus"), press("?", "Comma")])
      expect(onceAction({ ...key, shift: true })).toEqual({ kind: "help" });
    expect(onceAction(press("F1", "F1"))).toEqual({ kind: "help" });
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
      if (does !== undefined) expect(shown).toContain(`{Key${letter.toUpperCase()}}`);
    }
  });
});

describe("keysOf", () => {
  it("names the keys of a step's actions once each and passes over what it has none for", () => {
    expect(keysOf(["shot", "take_shot", "sing", "finish"])).toEqual([
      "1 … 6, {KeyX}, hold {KeyE}",
      "{KeyF}",
    ]);
  });

  it("names those of a scope where one is led", () => {
    expect(keysOf(["switch_hand", "take", "turn_shaft", "finish"], true)).toEqual([
      "{KeyH}",
      "{Comma} {Period}, Shift + drag",
      "{KeyF}",
    ]);
  });
});

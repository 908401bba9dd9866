// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { ScopePointers } from "./scope_pointers";

const MIDDLE = 200;
const finger = (id: number, x: number, y = 100) => ({ id, isFinger: true, turns: false, x, y });

describe("pointers on the scope's picture", () => {
  it("lean one hand by the mouse, and turn by its right button or Shift", () => {
    const pointers = new ScopePointers();
    const mouse = { ...finger(1, 100), isFinger: false };
    pointers.down(mouse, MIDDLE);
    expect(pointers.move(1, 104, 97, false)).toEqual({
      kind: "lean",
      lead: "first",
      right: 4,
      up: 3,
    });
    expect(pointers.move(1, 106, 97, true)).toEqual({ kind: "turn", right: 2 });
    pointers.up(1);
    pointers.down({ ...mouse, turns: true }, MIDDLE);
    expect(pointers.move(1, 105, 97, false)).toEqual({ kind: "turn", right: 5 });
  });

  it("lead two hands by two fingers, one on each half, each by its own way", () => {
    const pointers = new ScopePointers();
    pointers.down(finger(1, 120), MIDDLE);
    pointers.down(finger(2, 280), MIDDLE);
    expect(pointers.move(2, 290, 100, false)).toEqual({
      kind: "lean",
      lead: "second",
      right: 10,
      up: 0,
    });
    expect(pointers.move(1, 118, 100, false)).toMatchObject({ lead: "first", right: -2 });
    // Over the middle it is still the hand that it took.
    expect(pointers.move(1, 260, 100, false)).toMatchObject({ lead: "first", right: 142 });
  });

  it("leave the other hand to the finger that stays, and the led one to the next", () => {
    const pointers = new ScopePointers();
    pointers.down(finger(1, 120), MIDDLE);
    pointers.down(finger(2, 280), MIDDLE);
    pointers.up(1);
    expect(pointers.move(2, 281, 100, false)).toMatchObject({ lead: "second", right: 1 });
    pointers.down(finger(3, 100), MIDDLE);
    expect(pointers.move(3, 101, 100, false)).toMatchObject({ lead: "first", right: 1 });
  });

  it("spread on one half, and what stays of two leans nothing", () => {
    const pointers = new ScopePointers();
    pointers.down(finger(1, 100), MIDDLE);
    pointers.down(finger(2, 140), MIDDLE);
    expect(pointers.move(2, 150, 100, false)).toEqual({ kind: "spread", apart: 10 });
    expect(pointers.move(1, 110, 100, false)).toEqual({ kind: "spread", apart: -10 });
    pointers.up(2);
    expect(pointers.move(1, 50, 100, false)).toBeUndefined();
  });

  it("pass over a third finger, and a finger beside the mouse", () => {
    const pointers = new ScopePointers();
    pointers.down({ ...finger(1, 100), isFinger: false }, MIDDLE);
    expect(pointers.down(finger(2, 300), MIDDLE)).toBe(false);
    expect(pointers.move(2, 310, 100, false)).toBeUndefined();
    pointers.clear();
    pointers.down(finger(1, 100), MIDDLE);
    pointers.down(finger(2, 300), MIDDLE);
    expect(pointers.down(finger(3, 100), MIDDLE)).toBe(false);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Ticked by what happened, not by what was pressed.
import { describe, expect, it } from "vitest";
import { BONE_LESSON } from "./bone_lesson";
import { FirstTouch, type Observation } from "./first_touch_model";
import { SCOPE_LESSON } from "./scope_lesson";

const rest: Observation = {
  screenRight: [1, 0, 0],
  screenUp: [0, 1, 0],
  free: { tip: [0, 0, 0], shaft: [0, 0, 1] },
  depthMm: 0,
  shots: 4,
  undos: 1,
  hand: 0,
  inJoint: false,
  scope: undefined,
};

describe("FirstTouch", () => {
  it("ticks nothing for an operation as it stands", () => {
    const touch = new FirstTouch(BONE_LESSON);
    expect(touch.observe(rest)).toBe(false);
    expect(touch.observe({ ...rest })).toBe(false);
    expect(touch.current).toBe("look");
  });

  it.each([
    ["look", { screenRight: [0.9, 0, -0.436] }],
    ["move", { free: { tip: [0, 3.1, 0], shaft: [0, 0, 1] } }],
    ["aim", { free: { tip: [0, 0, 0], shaft: [0.1, 0, 0.995] } }],
    ["drive", { free: undefined, depthMm: 1.1 }],
    ["shot", { shots: 5 }],
    ["undo", { undos: 2 }],
  ] as const)("ticks %s", (task, more) => {
    const touch = new FirstTouch(BONE_LESSON);
    touch.observe(rest);
    expect(touch.observe({ ...rest, ...more })).toBe(true);
    expect(touch.isDone(task)).toBe(true);
    expect(touch.finished).toBe(false);
  });

  it("passes over what trembles", () => {
    const touch = new FirstTouch(BONE_LESSON);
    touch.observe(rest);
    const trembling = { tip: [0.5, 0.5, 0], shaft: [0.02, 0, 0.9998] } as const;
    expect(touch.observe({ ...rest, free: trembling, depthMm: 0.4 })).toBe(false);
  });

  it("takes things in any order and ends with the last", () => {
    const touch = new FirstTouch(BONE_LESSON);
    touch.observe(rest);
    touch.observe({ ...rest, shots: 5 });
    expect(touch.current).toBe("look");
    const all: Observation = {
      ...rest,
      screenRight: [0, 0, 1],
      screenUp: [0, 1, 0],
      free: { tip: [9, 0, 0], shaft: [1, 0, 0] },
      depthMm: 2,
      shots: 5,
      undos: 2,
    };
    expect(touch.observe(all)).toBe(true);
    expect(touch.finished).toBe(true);
    expect(touch.current).toBeUndefined();
  });
});

describe("FirstTouch at a scope", () => {
  const scope = { tip: [0, 0, 0], shaft: [0, 0, 1], shaftDeg: 175, cameraDeg: 0 } as const;
  const looking: Observation = { ...rest, inJoint: true, scope };

  it.each([
    ["lean", { scope: { ...scope, shaft: [0.1, 0, 0.995] } }],
    ["look_round", { scope: { ...scope, shaftDeg: -160 } }],
    ["level", { scope: { ...scope, cameraDeg: 9 } }],
    ["other_hand", { hand: 1 }],
  ] as const)("ticks %s alone", (task, more) => {
    const touch = new FirstTouch(SCOPE_LESSON);
    touch.observe(looking);
    expect(touch.observe({ ...looking, ...more })).toBe(true);
    expect(SCOPE_LESSON.tasks.filter(({ id }) => touch.isDone(id)).map(({ id }) => id)).toEqual([
      task,
    ]);
  });

  it("takes a lean aside for no way in, and a turn back for none", () => {
    const touch = new FirstTouch(SCOPE_LESSON);
    touch.observe(looking);
    const aside = { ...scope, tip: [8, 0, 0.5], shaftDeg: -174 } as const;
    expect(touch.observe({ ...looking, scope: aside })).toBe(false);
  });

  it("goes in from outside, and counts what is seen from then on", () => {
    const touch = new FirstTouch(SCOPE_LESSON);
    touch.observe({ ...rest, scope: undefined });
    expect(touch.current).toBe("go_in");
    expect(touch.observe(looking)).toBe(true);
    expect(touch.current).toBe("lean");
    const leant = { ...scope, shaft: [0.1, 0, 0.995] } as const;
    expect(touch.observe({ ...looking, scope: leant })).toBe(true);
  });
});

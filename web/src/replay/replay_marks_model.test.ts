// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import {
  followedTick,
  looksOf,
  marksOf,
  neighbourOf,
  pairSteps,
  waitsAt,
} from "./replay_marks_model";

const event = (tick: number, kind: string, text = kind) => ({ tick, kind, text });

describe("marksOf", () => {
  const log = [
    event(10, "taken"),
    event(20, "shot_taken"),
    event(1000, "entered_bone"),
    event(3000, "left_far_side"),
    event(4000, "live_ended"),
  ];
  it("marks pictures, entries and harm, and leaves the rest to the log", () => {
    expect(marksOf(log).map((mark) => mark.kind)).toEqual(["picture", "entry", "harm", "picture"]);
    expect(looksOf(log)).toEqual([20, 4000]);
  });
  it("knows the next and the last", () => {
    const marks = marksOf(log);
    expect(neighbourOf(marks, 20, 1)?.tick).toBe(1000);
    expect(neighbourOf(marks, 3100, -1)?.tick).toBe(1000);
    expect(neighbourOf(marks, 4000, 1)).toBeUndefined();
  });
});

describe("two attempts", () => {
  const first = [event(100, "step_completed", "a"), event(300, "step_completed", "b")];
  const second = [
    event(50, "step_completed", "a"),
    event(60, "step_completed", "c"),
    event(500, "step_completed", "b"),
  ];
  const pairs = pairSteps(first, second, [400, 600]);
  it("are paired by the steps that both did, and their end", () => {
    expect(pairs.map((pair) => pair.ends)).toEqual([
      [100, 50],
      [300, 500],
      [400, 600],
    ]);
  });
  it("leave out a step that came in another order", () => {
    const turned = [event(50, "step_completed", "b"), event(90, "step_completed", "a")];
    expect(pairSteps(first, turned, [400, 600]).map((pair) => pair.text)).toEqual(["a", "The end"]);
  });
  it("stand as far into the same step, and no farther than its end", () => {
    expect(followedTick(pairs, 0, 30)).toBe(30);
    expect(followedTick(pairs, 0, 90)).toBe(50);
    expect(followedTick(pairs, 0, 150)).toBe(100);
    expect(followedTick(pairs, 1, 450)).toBe(300);
    expect(followedTick(pairs, 1, 9999)).toBe(400);
  });
  it("wait for each other at the end of each step", () => {
    expect(waitsAt(pairs, [20, 50])).toEqual([100, 50]);
    expect(waitsAt(pairs, [100, 50])).toEqual([300, 500]);
    expect(waitsAt(pairs, [400, 600])).toEqual([400, 600]);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { AttemptSummary, ScoreItem } from "../protocol";
import { chosenFor, figureRows, scaleOf } from "./figures_model";
import { NO_FILTER } from "./review_model";

function attempt(id: number, trainee: string, changes: Partial<AttemptSummary> = {}) {
  return {
    id,
    trainee,
    case: "demo",
    case_fingerprint: "0",
    case_simulated: true,
    procedure: "dorsal",
    mode: "practice",
    input_device: "mouse",
    started_at: "2026-11-21T12:00:00Z",
    ended_at: "2026-11-21T12:10:00Z",
    outcome: "finished",
    overall: 50,
    duration_s: 600,
    state_hash: "0",
    asset: null,
    ...changes,
  } satisfies AttemptSummary;
}

function item(value: number | null, changes: Partial<ScoreItem> = {}): ScoreItem {
  return {
    id: "wire_bend_deg",
    label: "Wire bent",
    value,
    unit: "deg",
    target: "at most 1° good, over 10° fails",
    grade: "good",
    points: 0,
    points_possible: 2,
    reason: "",
    mark: null,
    ...changes,
  };
}

describe("chosenFor", () => {
  it("takes one's last, the last of each of the others, and finished ones alone", () => {
    const all = [
      ...Array.from({ length: 14 }, (_, i) => attempt(i + 1, "Ada")),
      attempt(20, "Ada", { outcome: "unfinished", overall: null }),
      ...[30, 31, 32].map((id) => attempt(id, "Bela")),
      attempt(40, "scripted expert 1", { input_device: "script" }),
      attempt(41, "scripted novice 1", { input_device: "script" }),
    ];
    const chosen = chosenFor(all, { ...NO_FILTER, trainee: "Ada" });
    expect(chosen.own.map(({ id }) => id)).toEqual([5, 6, 7, 8, 9, 10, 11, 12, 13, 14]);
    expect(chosen.group.map(({ id }) => id)).toEqual([32, 31]);
    expect(chosen.expert.map(({ id }) => id)).toEqual([40]);
  });
});

describe("figureRows", () => {
  it("sets own, group, expert and what is good side by side", () => {
    const [row] = figureRows(
      [[item(8)], [item(null)], [item(2, { grade: "acceptable" })]],
      [[item(1)], [item(3)], [item(5)]],
      [[item(0)]],
    );
    expect(row).toMatchObject({
      own: [8, 2],
      grade: "acceptable",
      group: { low: 2, middle: 3, high: 4 },
      expert: 0,
      band: { from: -Infinity, to: 1 },
    });
  });
  it("has no group of one, and no row without an attempt", () => {
    expect(figureRows([[item(1)]], [[item(1)]], [])[0]?.group).toBeUndefined();
    expect(figureRows([], [[item(1)]], [])).toEqual([]);
  });
});

describe("scaleOf", () => {
  it("holds all that is drawn, and is never empty", () => {
    const [row, none] = figureRows([[item(8), item(null, { id: "other", target: "" })]], [], []);
    if (row === undefined || none === undefined) throw new Error("no rows");
    const [low, high] = scaleOf(row);
    expect(low).toBeLessThan(1);
    expect(high).toBeGreaterThan(8);
    expect(scaleOf(none)).toEqual([0, 1]);
    expect(scaleOf({ ...row, own: [0], band: { from: -Infinity, to: 0 } })).toEqual([-0.5, 0.5]);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { AttemptSummary } from "../protocol";
import {
  choicesOf,
  compare,
  csvOf,
  groupCurve,
  inScope,
  jsonOf,
  madeBy,
  NO_FILTER,
  quantile,
  traineeOf,
} from "./review_model";

let next = 1;
function attempt(changes: Partial<AttemptSummary>): AttemptSummary {
  return {
    id: next++,
    trainee: "Ada",
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
  };
}

const expert = { trainee: "scripted expert 3", input_device: "script", overall: 95 };

describe("the filter", () => {
  const all = [
    attempt({}),
    attempt({ procedure: "volar" }),
    attempt({ mode: "assessed", trainee: "" }),
    attempt({ started_at: "2026-10-01T12:00:00Z", case: "other" }),
    attempt(expert),
  ];
  it("leaves what was asked for", () => {
    expect(inScope(all, { ...NO_FILTER, procedure: "volar" })).toHaveLength(1);
    expect(inScope(all, { ...NO_FILTER, mode: "assessed" })).toHaveLength(1);
    expect(inScope(all, { ...NO_FILTER, case: "other" })).toHaveLength(1);
    expect(inScope(all, { ...NO_FILTER, from: "2026-11-01" })).toHaveLength(4);
    expect(inScope(all, { ...NO_FILTER, to: "2026-10-31" })).toHaveLength(1);
    expect(choicesOf(all, traineeOf)).toEqual(["Ada", "not named", "scripted expert 3"]);
  });
  it("tells own, group and expert apart", () => {
    const filter = { ...NO_FILTER, trainee: "Ada" };
    expect(madeBy(all, filter, "own")).toHaveLength(3);
    expect(madeBy(all, filter, "group").map(traineeOf)).toEqual(["not named"]);
    expect(madeBy(all, filter, "expert")).toHaveLength(1);
    expect(madeBy(all, NO_FILTER, "own")).toHaveLength(4);
  });
});

describe("the comparison", () => {
  it("sets past and present, others and the expert side by side", () => {
    const all = [
      ...[0, 10, 20, 40, 60, 80, 90].map((overall) => attempt({ overall })),
      attempt({ trainee: "Bela", overall: 30 }),
      attempt({ outcome: "unfinished", overall: null }),
      attempt(expert),
    ];
    const rows = compare(all, { ...NO_FILTER, trainee: "Ada" });
    expect(rows.map((row) => [row.name, row.attempts, row.score])).toEqual([
      ["Ada", 7, 40],
      ["… the first 3", 3, 10],
      ["… the last 3", 3, 80],
      ["All others", 1, 30],
      ["Scripted expert, in silico", 1, 95],
    ]);
    expect(rows[0]?.safe).toBeCloseTo(6 / 7);
    expect(compare([], NO_FILTER)[0]?.score).toBeUndefined();
  });
  it("shows how a group learns, and of one alone nothing", () => {
    const two = ["Bela", "Cleo"].flatMap((trainee) =>
      [10, 30].map((overall) => attempt({ trainee, overall })),
    );
    const curve = groupCurve(two, { ...NO_FILTER, trainee: "Ada" }, 5);
    expect(curve.map((point) => point.middle)).toEqual([10, 30]);
    expect(groupCurve(two.slice(0, 2), { ...NO_FILTER, trainee: "Ada" }, 5)).toEqual([]);
  });
  it("takes quantiles between values", () => {
    expect(quantile([1, 2, 3, 4], 0.5)).toBe(2.5);
    expect(quantile([], 0.5)).toBeUndefined();
  });
});

describe("what leaves", () => {
  it("quotes, and is no formula", () => {
    const text = csvOf([attempt({ id: 1, trainee: '=HYPERLINK("x"), Ada', overall: null })]);
    const [head, row] = text.split("\r\n");
    expect(head?.startsWith("id,started_at")).toBe(true);
    expect(row).toContain(`"'=HYPERLINK(""x""), Ada"`);
    expect(row).toContain(",finished,,600,");
  });
  it("tells what instructors said by the ASSET, where they did", () => {
    const asset = { forms: 2, passed: 1, mean_total: 25.5 };
    const [head, rated, unrated] = csvOf([attempt({ asset }), attempt({})]).split("\r\n");
    expect(head?.endsWith(",asset_forms,asset_passed,asset_mean_total")).toBe(true);
    expect(rated?.endsWith(",2,1,25.5")).toBe(true);
    expect(unrated?.endsWith(",,,")).toBe(true);
  });
  it("is a list as the program writes it", () => {
    const list = JSON.parse(jsonOf([attempt({})])) as { total: number; attempts: unknown[] };
    expect(list.total).toBe(1);
    expect(list.attempts).toHaveLength(1);
  });
});

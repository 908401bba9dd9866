// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { askedFor, beadsOf, drillWords, sameBeads, stageOf } from "./scope_drill_model";
import type { Drill, DrillState } from "./scope_drill_model";
import type { Plan } from "./scope_plan";

const drill: Drill = {
  hold: [2, 7],
  hold_s: 3,
  middle_deg: 13,
  round_places: 5,
  touch: [8, 2],
  line_mm: [
    [0, 0, 0],
    [1, 0, 0],
    [2, 0, 0],
  ],
  line_body: "radius",
};
const begun: DrillState = {
  held: 0,
  hold_share: 0,
  level: true,
  round_most: 0,
  round_done: false,
  touched: 0,
  line_share: 0,
  line_done: false,
  probe_seen: true,
};
const points = [2, 7, 8].map((number) => ({
  number,
  name: `place ${number}`,
  found_by: "",
  joint: "radiocarpal",
  is_probed: false,
  at_mm: [number, 0, 0] as const,
  body: "radius",
}));
const plan = { points } as unknown as Plan;
const held = { ...begun, held: 2 };
const round = { ...held, round_done: true };
const touched = { ...round, touched: 2 };

describe("exercises with a scope", () => {
  it("follow one another", () => {
    expect(stageOf(drill, begun)).toBe("hold");
    expect(stageOf(drill, held)).toBe("round");
    expect(stageOf(drill, round)).toBe("touch");
    expect(stageOf(drill, touched)).toBe("line");
    expect(stageOf(drill, { ...touched, line_done: true })).toBe("done");
  });

  it("ask for one place at a time", () => {
    expect(askedFor(drill, begun)).toBe(2);
    expect(askedFor(drill, { ...begun, held: 1 })).toBe(7);
    expect(askedFor(drill, held)).toBeUndefined();
    expect(askedFor(drill, { ...round, touched: 1 })).toBe(2);
  });

  it("say what is to be done and how far it is", () => {
    expect(drillWords(plan, drill, begun)).toBe("1 of 2 · place 2: bring it into the ring");
    expect(drillWords(plan, drill, { ...begun, level: false })).toContain("level");
    expect(drillWords(plan, drill, { ...begun, hold_share: 0.4 })).toBe(
      "1 of 2 · place 2: 1.2 of 3 s",
    );
    expect(drillWords(plan, drill, { ...held, round_most: 3 })).toContain("3 of 5 places");
    expect(drillWords(plan, drill, { ...round, probe_seen: false })).toContain("does not see");
    expect(drillWords(plan, drill, { ...touched, line_share: 0.42 })).toBe("Follow the line: 42 %");
  });

  it("are marked in practice alone", () => {
    expect(beadsOf(plan, drill, begun, false)).toEqual([]);
    expect(beadsOf(plan, drill, begun, true)).toEqual([
      { atMm: [2, 0, 0], body: "radius", kind: "asked" },
    ]);
    const line = beadsOf(plan, drill, { ...touched, line_share: 0.5 }, true);
    expect(line.map((bead) => bead.kind)).toEqual(["passed", "passed", "line"]);
    expect(sameBeads(line, beadsOf(plan, drill, { ...touched, line_share: 0.6 }, true))).toBe(true);
    expect(sameBeads(line, beadsOf(plan, drill, touched, true))).toBe(false);
  });
});

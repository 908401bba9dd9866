// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts that go on from each other become one surface, others do not; a thread's pitch runs evenly.
import { describe, expect, it } from "vitest";
import { chains, threadTurns, turned, type InstrumentPart } from "./instrument_model";
import { screwDriverParts, screwParts, wireDriverParts, wireParts } from "./instrument_set";

const rod: InstrumentPart = {
  kind: "cylinder",
  from_mm: 0,
  to_mm: 10,
  radius_mm: 2,
  material: "steel",
};

describe("chains", () => {
  it("join cones and cylinders that go on from each other", () => {
    const [chain, ...rest] = chains(
      turned(
        [
          [0, 0],
          [1, 2],
          [1, 9],
          [3, 12],
        ],
        "steel",
      ),
    );
    expect(rest).toEqual([]);
    expect(chain?.profile).toEqual([
      [0, 0],
      [1, 2],
      [1, 9],
      [3, 12],
    ]);
  });

  it.each([
    ["of another material", { material: "black" }],
    ["after a gap", { from_mm: 10.5 }],
    ["after a shoulder", { radius_mm: 2.5 }],
    ["that is threaded", { kind: "threaded" }],
    ["on an axis of its own", { axis: [0, 1, 0] }],
  ] as const)("do not join a part %s", (_, other) => {
    const next: InstrumentPart = { ...rod, from_mm: 10, to_mm: 20, ...other };
    expect(chains([rod, next]).length).toBe(2);
  });
});

describe("turned", () => {
  it("names a part whose radius does not change a cylinder", () => {
    const kinds = turned(
      [
        [0, 0],
        [1, 2],
        [1, 9],
      ],
      "steel",
    ).map((part) => part.kind);
    expect(kinds).toEqual(["cone", "cylinder"]);
  });
});

describe("threadTurns", () => {
  it("counts turns of one pitch", () => {
    expect(threadTurns(0.5, 20, 2, 2)).toBeCloseTo(5, 9);
  });

  it("has at each place the pitch that runs evenly between the ends", () => {
    const step = 1e-6;
    for (const t of [0, 0.3, 1 - step]) {
      const turns = threadTurns(t + step, 20, 1.4, 0.9) - threadTurns(t, 20, 1.4, 0.9);
      expect((20 * step) / turns).toBeCloseTo(1.4 + t * (0.9 - 1.4), 4);
    }
  });
});

describe("the instruments", () => {
  const shape = { length_mm: 20, tip_diameter_mm: 3.3, tail_diameter_mm: 3.8 };
  it.each([
    ["wire", wireParts(), 0, 150],
    ["screw", screwParts(shape), 0, 20],
    ["wire driver", wireDriverParts(), 72, 166],
    ["screw driver", screwDriverParts(), -0.8, 124],
  ] as const)("%s lies along +z from its tip to the hand", (_, parts, from, to) => {
    const onAxis = parts.filter((part) => part.axis === undefined);
    expect(Math.min(...onAxis.map((part) => part.from_mm))).toBeCloseTo(from, 9);
    expect(Math.max(...onAxis.map((part) => part.to_mm))).toBeCloseTo(to, 9);
    for (const part of parts) expect(part.to_mm).toBeGreaterThan(part.from_mm);
  });
});

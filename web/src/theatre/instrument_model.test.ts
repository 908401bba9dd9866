// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts that go on from each other become one surface, others do not; a thread's pitch runs evenly.
import { describe, expect, it } from "vitest";
import type { InstrumentPart } from "../protocol";
import { chains, partsBetween, threadTurns } from "./instrument_model";

function part(more: Partial<InstrumentPart> = {}): InstrumentPart {
  return {
    from_mm: 0,
    to_mm: 10,
    radius_mm: 2,
    end_radius_mm: 2,
    is_threaded: false,
    pitch_mm: 0,
    end_pitch_mm: 0,
    material: "steel",
    only_in_hand: false,
    origin_mm: [0, 0, 0],
    axis: [0, 0, 1],
    squash: [1, 1],
    ...more,
  };
}

describe("chains", () => {
  it("join parts that go on from each other", () => {
    const [chain, ...rest] = chains([
      part({ to_mm: 2, radius_mm: 0, end_radius_mm: 1 }),
      part({ from_mm: 2, to_mm: 9, radius_mm: 1, end_radius_mm: 1 }),
      part({ from_mm: 9, to_mm: 12, radius_mm: 1, end_radius_mm: 3 }),
    ]);
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
    ["that is threaded", { is_threaded: true }],
    ["on another axis", { axis: [0, 1, 0] }],
    ["of what holds it", { only_in_hand: true }],
  ] as const)("do not join a part %s", (_, other) => {
    const next = part({ from_mm: 10, to_mm: 20, ...other });
    expect(chains([part(), next]).length).toBe(2);
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

describe("partsBetween", () => {
  const tip = part({ to_mm: 2, radius_mm: 0, end_radius_mm: 1 });
  const shaft = part({ from_mm: 2, to_mm: 150, radius_mm: 1, end_radius_mm: 1 });

  it("leaves what lies between as it is", () => {
    expect(partsBetween([tip, shaft], 0, 150)).toEqual([tip, shaft]);
  });

  it("cuts a cone where its radius then is", () => {
    expect(partsBetween([tip, shaft], 0, 1)).toEqual([{ ...tip, to_mm: 1, end_radius_mm: 0.5 }]);
  });

  it("gives the two pieces of a bent wire, without a gap", () => {
    const [inner, outer] = [partsBetween([tip, shaft], 0, 30), partsBetween([tip, shaft], 30, 150)];
    expect(inner.at(-1)?.to_mm).toBe(30);
    expect(outer).toEqual([{ ...shaft, from_mm: 30 }]);
  });
});

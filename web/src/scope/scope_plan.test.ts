// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { areAtScope, cutPlaces, type Plan } from "./scope_plan";

const plan = (kinds: readonly ("synovium" | "disc")[]): Plan =>
  ({ pieces: kinds.map((kind, i) => ({ kind, inwards: [0, i, 1] })) }) as unknown as Plan;

describe("places of the disc that were cut away", () => {
  it("are those of which nothing is left, each with its way out of the joint", () => {
    const cut = cutPlaces(plan(["disc", "disc", "disc"]), [0, 1, 0]);
    expect(cut.map(({ place }) => place)).toEqual([0, 2]);
    expect(cut[1]?.outwards).toEqual([-0, -2, -1]);
  });

  it("are none while nothing was told, nor of synovium", () => {
    expect(cutPlaces(plan(["disc"]), [])).toEqual([]);
    expect(cutPlaces(plan(["synovium"]), [0])).toEqual([]);
  });
});

describe("hands where portals are made before a scope goes in", () => {
  const instruments = [
    { id: "needle", skin_work: "needle" },
    { id: "scope", skin_work: "none" },
    { id: "probe", skin_work: "none" },
  ] as const;
  const held = (...ids: string[]): { hand: number; instrument: string }[] =>
    ids.map((instrument, hand) => ({ hand, instrument }));

  it("are at the scope once one has taken it, whatever the other holds that goes in too", () => {
    expect(areAtScope(held("scope"), instruments)).toBe(true);
    expect(areAtScope(held("scope", "probe"), instruments)).toBe(true);
  });

  it("are at the skin with empty hands, or while either works there", () => {
    expect(areAtScope([], instruments)).toBe(false);
    expect(areAtScope(held("needle"), instruments)).toBe(false);
    expect(areAtScope(held("scope", "needle"), instruments)).toBe(false);
    expect(areAtScope([{ hand: -1, instrument: "scope" }], instruments)).toBe(false);
  });
});

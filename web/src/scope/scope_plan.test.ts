// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { cutPlaces, isAtScope, type Plan } from "./scope_plan";

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

  it("are led at the scope while theirs holds what goes in, or is empty beside it", () => {
    expect(isAtScope(held("scope"), instruments, 0)).toBe(true);
    expect(isAtScope(held("scope"), instruments, 1)).toBe(true);
    expect(isAtScope(held("scope", "probe"), instruments, 1)).toBe(true);
    expect(isAtScope(held("scope", "needle"), instruments, 0)).toBe(true);
  });

  it("are led at the skin with empty hands, or while theirs works there", () => {
    expect(isAtScope([], instruments, 0)).toBe(false);
    expect(isAtScope(held("needle"), instruments, 0)).toBe(false);
    expect(isAtScope(held("needle"), instruments, 1)).toBe(false);
    expect(isAtScope(held("scope", "needle"), instruments, 1)).toBe(false);
    expect(isAtScope([{ hand: -1, instrument: "scope" }], instruments, 0)).toBe(false);
  });
});

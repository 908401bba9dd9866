// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { cutPlaces, type Plan } from "./scope_plan";

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

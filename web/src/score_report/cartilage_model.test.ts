// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { paintedVertices, rowOf } from "./cartilage_model";

const bone = {
  bone: "lunate",
  seen_share: 50,
  at_mm: [
    [0, 0, 0],
    [3, 0, 0],
  ] as [number, number, number][],
  seen: [1, 0],
};

describe("cartilage on a bone", () => {
  it("is what the nearest facet was, and bone where none is near", () => {
    const positions = [0.2, 0.3, -0.1, 2.7, 0, 0.4, 1.4, 0, 0, 0, 5, 0, -1.1, 0, 0];
    expect(paintedVertices(bone, positions)).toEqual(["seen", "missed", "bone", "bone", "seen"]);
  });
  it("is found across the cubes that facets are kept in", () => {
    const at = { ...bone, at_mm: [[1.19, 1.19, 1.19]] as [number, number, number][], seen: [1] };
    expect(paintedVertices(at, [1.21, 1.21, 1.21])).toEqual(["seen"]);
  });
});

describe("rows of the wrist", () => {
  it("hold the bones that belong together", () => {
    expect(["radius", "scaphoid_proximal", "lunate", "capitate"].map(rowOf)).toEqual([0, 1, 1, 2]);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { partsFrom, sideAt, sideOf, type SidedWall } from "./wall_sides";

const [RADIUS, SCAPHOID, LUNATE, ULNA] = [0, 1, 2, 3];
/** Radius below, scaphoid and lunate above, 0.4 mm off: so near they lie in the scan. */
const wall: SidedWall = {
  rest: new Float32Array([-1, 0, 0, 1, 0, 0, -1, 0, 0.4, 0.5, 0, 0.4, 1, 0, 0.4]),
  proximal: [RADIUS, RADIUS, RADIUS, RADIUS, RADIUS],
  distal: [SCAPHOID, LUNATE, SCAPHOID, LUNATE, LUNATE],
  distalShare: [0, 0.1, 0.9, 1, 1],
};

describe("the sides of a joint's wall", () => {
  it("are told by the bone, however near the other side is", () => {
    expect(sideOf(wall, RADIUS)).toBe(0);
    expect(sideOf(wall, SCAPHOID)).toBe(1);
    expect(sideOf(wall, ULNA)).toBe(0);
  });

  it("are told by the nearest wall where only a place on a bone's surface is known", () => {
    expect(sideAt(wall, [1, 0, -0.15])).toBe(0);
    expect(sideAt(wall, [-1, 0, 0.55])).toBe(1);
  });

  it("tell the bone that another one parts from beside a line, on its own side alone", () => {
    expect(partsFrom(wall, SCAPHOID, [0, -1, 0.4], [0, 1, 0.4])).toBe(LUNATE);
    expect(partsFrom(wall, LUNATE, [0, -1, 0.4], [0, 1, 0.4])).toBe(SCAPHOID);
    expect(partsFrom(wall, RADIUS, [0, -1, 0], [0, 1, 0])).toBeUndefined();
    expect(partsFrom(wall, SCAPHOID, [0, 40, 0], [0, 42, 0])).toBeUndefined();
  });
});

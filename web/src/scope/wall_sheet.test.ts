// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import type { BodyPose } from "../protocol";
import { WallSheet, type SheetPlan } from "./wall_sheet";

const REST: BodyPose = { quaternion: [1, 0, 0, 0], translation_mm: [0, 0, 0] };
const ligament = (places: SheetPlan["places_mm"]): SheetPlan => ({
  id: "scapholunate",
  joint: "radiocarpal",
  body: "scaphoid",
  kind: "ligament",
  places_mm: places,
});
/** On the ligament, beside it, and on the joint's other side, 0.6 mm off. */
const rest = new Float32Array([0, 0, 0, 4, 0, 0, 0, 0, -0.6]);
const wall = {
  rest,
  normals: new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, -1]),
  isDisc: [false, false, false],
  distalShare: [1, 1, 1],
  distal: [0, 0, 0],
};

describe("a ligament of the wall", () => {
  it("is dented where it lies, and not on the other side of the joint", () => {
    const sheet = new WallSheet(wall, ligament([[0, 0, 0.5]]), 0);
    sheet.yield([0, 0, 800]);
    const position = new Float32Array(rest);
    sheet.addTo(position, rest, [REST]);
    expect(position[2]).toBeCloseTo(0.8, 5);
    expect([...position.slice(3)]).toEqual([...rest.slice(3)]);
  });

  it("lies where its own body and the host have it, wherever the wall was laid", () => {
    const sheet = new WallSheet(wall, ligament([[0, 0, 0.5]]), 0);
    const position = new Float32Array([9, 9, 9, 4, 0, 0, 0, 0, -0.6]);
    sheet.yield([0, 1000, 0]);
    const half = Math.SQRT1_2;
    sheet.addTo(position, rest, [{ quaternion: [half, 0, 0, half], translation_mm: [0, 0, 2] }]);
    // A quarter turn about z takes y to -x.
    expect(position[0]).toBeCloseTo(-1, 5);
    expect(position[1]).toBeCloseTo(0, 5);
    expect(position[2]).toBeCloseTo(2, 5);
  });

  it("does not take along what touches it from the other side, whichever that is", () => {
    for (const [distal, distalShare] of [
      [0, 0],
      [1, 1],
    ] as const) {
      const touching = {
        ...wall,
        distal: [distal, distal, distal],
        distalShare: [distalShare, distalShare, distalShare],
      };
      const sheet = new WallSheet(touching, ligament([[0, 0, 0.5]]), 0);
      sheet.yield([0, 0, 800]);
      const position = new Float32Array(rest);
      sheet.addTo(position, rest, [REST, REST]);
      expect([...position]).toEqual([...rest]);
    }
  });

  it("goes along less and less beyond its rim", () => {
    const xs = [0, 1, 1.5, 2, 3];
    const row = new Float32Array(xs.flatMap((x) => [x, 0, 0]));
    const normals = new Float32Array(xs.flatMap(() => [0, 0, 1]));
    const along = {
      rest: row,
      normals,
      isDisc: xs.map(() => false),
      distalShare: xs.map(() => 1),
      distal: xs.map(() => 0),
    };
    const sheet = new WallSheet(along, ligament([[0, 0, 0.5]]), 0);
    sheet.yield([0, 0, 1000]);
    const position = new Float32Array(row);
    sheet.addTo(position, row, [REST]);
    const high = xs.map((_, i) => position[3 * i + 2] ?? 0);
    expect(high[0]).toBeCloseTo(1, 5);
    expect(high[4]).toBe(0);
    for (let i = 1; i < high.length; ++i) expect(high[i]).toBeLessThanOrEqual(high[i - 1] ?? 0);
    expect(high[3]).toBeGreaterThan(0);
    expect(high[3]).toBeLessThan(1);
    expect(new THREE.Vector3().fromArray(position, 12).x).toBe(3);
  });

  it("shows no place of its own as a step where it is pressed aslant", () => {
    const EVERY_MM = 0.25;
    const xs = Array.from({ length: 41 }, (_, i) => 5.03 + EVERY_MM * i);
    const row = new Float32Array(xs.flatMap((x) => [x, 0, 0]));
    const along = {
      rest: row,
      normals: new Float32Array(xs.flatMap(() => [0, 0, 1])),
      isDisc: xs.map(() => false),
      distalShare: xs.map(() => 1),
      distal: xs.map(() => 0),
    };
    const places = Array.from(
      { length: 60 },
      (_, i) => [i % 20, Math.floor(i / 20) - 1, 0.5] as const,
    );
    const sheet = new WallSheet(along, ligament(places), 0);
    sheet.yield(places.flatMap(([x]) => [0, 0, 100 * x])); // a tenth of a millimetre each
    const position = new Float32Array(row);
    sheet.addTo(position, row, [REST]);
    const high = xs.map((_, i) => position[3 * i + 2] ?? 0);
    const meant = 0.1 * EVERY_MM;
    for (let i = 1; i < high.length; ++i) {
      const step = (high[i] ?? 0) - (high[i - 1] ?? 0);
      expect(step).toBeGreaterThan(0.8 * meant);
      expect(step).toBeLessThan(1.2 * meant);
    }
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import type { BodyPose } from "../protocol";
import { jointWallOf } from "./joint_wall";
import type { SheetPlan } from "./wall_sheet";

/** Four vertices a millimetre apart: disc, disc, ligament far off, cartilage; all with body 0. */
function wall() {
  const surface = new THREE.BufferGeometry();
  surface.setAttribute(
    "position",
    new THREE.Float32BufferAttribute([0, 0, 0, 1, 0, 0, 30, 0, 0, 0, 30, 0], 3),
  );
  surface.setIndex([0, 1, 2, 0, 2, 3]);
  const scalars = (name: string, values: number[]): void => {
    surface.setAttribute(name, new THREE.Float32BufferAttribute(values, 1));
  };
  scalars("_lining", [3, 3, 4, 2]);
  scalars("_proximal", [0, 0, 0, 0]);
  scalars("_distal", [1, 1, 1, 1]);
  scalars("_distal_share", [0, 0, 0, 1]);
  const four = (name: string, values: number[]): void => {
    surface.setAttribute(name, new THREE.Float32BufferAttribute(values, 4));
  };
  four("_bodies", [0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0]);
  four("_shares", [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]);
  const made = jointWallOf("radiocarpal", surface);
  if (made === undefined) throw new Error("no wall");
  return made;
}

/** A disc of these places, on body 0. */
const disc = (...places: [number, number, number][]): SheetPlan => ({
  id: "disc",
  joint: "radiocarpal",
  body: "radius",
  kind: "disc",
  places_mm: places,
});
const BODIES = ["radius", "lunate"];

const REST: BodyPose = { quaternion: [1, 0, 0, 0], translation_mm: [0, 0, 0] };
const at = (made: ReturnType<typeof wall>, v: number): number[] => {
  const position = made.geometry.getAttribute("position");
  return [position.getX(v), position.getY(v), position.getZ(v)];
};

describe("the wall of a joint", () => {
  it("goes with the bones on both sides", () => {
    const made = wall();
    made.pose([REST, { ...REST, translation_mm: [0, 0, 5] }]);
    expect(at(made, 0)).toEqual([0, 0, 0]);
    expect(at(made, 3)).toEqual([0, 30, 5]);
  });

  it("yields where the disc does, and nowhere else", () => {
    const made = wall();
    made.setSheets([disc([0, 0, -0.7], [1, 0, -0.7])], BODIES);
    expect(made.yieldSheet(0, [0, 0, -1000, 0, 0, -1000])).toBe(true);
    expect(made.yieldSheet(1, [])).toBe(false);
    made.pose([REST, REST]);
    expect(at(made, 0)[2]).toBeCloseTo(-1, 5);
    expect(at(made, 1)[2]).toBeCloseTo(-1, 5);
    expect(at(made, 2)).toEqual([30, 0, 0]);
    made.yieldSheet(0, []);
    made.pose([REST, REST]);
    expect(at(made, 0)).toEqual([0, 0, 0]);
  });

  it("is moved outwards where the disc was cut away, and marked as gone there", () => {
    const made = wall();
    made.setSheets([disc([0, 0, -0.7], [1, 0, -0.7])], BODIES);
    const gone = (v: number): number => made.geometry.getAttribute("gone").getX(v);
    expect([0, 1, 2, 3].map(gone)).toEqual([0, 0, 0, 0]);
    made.cutDisc([{ place: 0, outwards: [0, 0, -1] }]);
    made.pose([REST, REST]);
    expect(at(made, 0)[2]).toBeLessThan(-0.8);
    expect(at(made, 1)[2]).toBeGreaterThan(at(made, 0)[2] ?? 0);
    expect(gone(0)).toBeGreaterThan(0.6);
    expect(gone(1)).toBeLessThan(0.4);
    expect(at(made, 2)).toEqual([30, 0, 0]);
    made.cutDisc([
      { place: 0, outwards: [0, 0, -1] },
      { place: 1, outwards: [0, 0, -1] },
    ]);
    made.pose([REST, REST]);
    expect(at(made, 0)[2]).toBeCloseTo(-1.7, 5);
    expect(at(made, 1)[2]).toBeCloseTo(-1.7, 5);
    expect(gone(1)).toBeCloseTo(1, 5);
    expect(gone(3)).toBe(0);
  });

  it("is whole again in the next exercise, and where cutting was undone", () => {
    const made = wall();
    made.setSheets([disc([0, 0, -0.7])], BODIES);
    for (const mend of [
      () => {
        made.cutDisc([]);
      },
      () => {
        made.setSheets([disc([0, 0, -0.7])], BODIES);
      },
    ]) {
      made.cutDisc([{ place: 0, outwards: [0, 0, -1] }]);
      made.pose([REST, REST]);
      expect(at(made, 0)[2]).toBeCloseTo(-1.7, 5);
      mend();
      made.pose([REST, REST]);
      expect(at(made, 0)).toEqual([0, 0, 0]);
      expect(made.geometry.getAttribute("gone").getX(0)).toBe(0);
    }
  });

  it("turns what has yielded with the forearm", () => {
    const made = wall();
    made.setSheets([disc([0, 0, 0])], BODIES);
    made.yieldSheet(0, [0, 0, -1000]);
    const half = Math.SQRT1_2; // a quarter turn about x: -z becomes +y
    made.pose([{ quaternion: [half, half, 0, 0], translation_mm: [0, 0, 0] }, REST]);
    expect(at(made, 0)[1]).toBeCloseTo(1, 5);
  });

  it("keeps where each place was as scanned, for what is painted there", () => {
    const made = wall();
    made.pose([{ ...REST, translation_mm: [7, 0, 0] }, REST]);
    expect(made.geometry.getAttribute("rest").getX(1)).toBe(1);
    expect(at(made, 1)[0]).toBeCloseTo(8, 5);
  });
});

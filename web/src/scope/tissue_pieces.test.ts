// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import {
  flapGeometry,
  stands,
  TissuePieces,
  tuftGeometry,
  type TissuePiece,
} from "./tissue_pieces";

/** The lens. */
const FAR = [50, 0, 0] as const;
const JOINT = "radiocarpal";
const tuft = (x: number): TissuePiece => ({
  kind: "synovium",
  joint: JOINT,
  body: "radius",
  at_mm: [x, 0, 0],
  inwards: [0, 0, 1],
  height_mm: 1,
  radius_mm: 0.4,
  is_loose: false,
});
const place = (isLoose: boolean): TissuePiece => ({
  ...tuft(0),
  kind: "disc",
  height_mm: 0,
  is_loose: isLoose,
});

function made(pieces: readonly TissuePiece[]): TissuePieces {
  const all = new TissuePieces(new THREE.MeshBasicMaterial());
  all.set(pieces, ["ulna", "radius"]);
  return all;
}

function mesh(all: TissuePieces): THREE.InstancedMesh {
  const [first] = all.group.children;
  if (!(first instanceof THREE.InstancedMesh)) throw new Error("nothing is drawn");
  return first;
}

/** Where an instance stands, and how high it is. */
function standing(all: TissuePieces, i: number): { at: THREE.Vector3; size: THREE.Vector3 } {
  const matrix = new THREE.Matrix4();
  mesh(all).getMatrixAt(i, matrix);
  const [at, turn, size] = [new THREE.Vector3(), new THREE.Quaternion(), new THREE.Vector3()];
  matrix.decompose(at, turn, size);
  return { at, size };
}

/** The way an instance points. */
function pointing(all: TissuePieces, i: number): THREE.Vector3 {
  const matrix = new THREE.Matrix4();
  mesh(all).getMatrixAt(i, matrix);
  return new THREE.Vector3().setFromMatrixColumn(matrix, 2).normalize();
}

describe("what a shaver takes away", () => {
  it("stands where it is synovium or hangs loose; what is sound of the disc is the wall", () => {
    expect(stands(tuft(0))).toBe(true);
    expect(stands(place(true))).toBe(true);
    expect(stands(place(false))).toBe(false);
    expect(made([place(false), place(false)]).group.children.length).toBe(0);
  });

  it("becomes fewer and lower as less is left of it, in one draw call", () => {
    const all = made([tuft(0), tuft(1), tuft(2)]);
    expect(all.group.children.length).toBe(1);
    all.show(JOINT, [], undefined, FAR, 0);
    expect(mesh(all).count).toBe(3);
    const whole = standing(all, 1).size.z;
    all.show(JOINT, [100, 40, 100], undefined, FAR, 0);
    expect(mesh(all).count).toBe(3);
    expect(standing(all, 1).size.z).toBeLessThan(whole);
    all.show(JOINT, [0, 40, 100], undefined, FAR, 0);
    expect(mesh(all).count).toBe(2);
    expect(standing(all, 0).at.x).toBeCloseTo(1, 6);
    all.show(JOINT, [0, 0, 0], undefined, FAR, 0);
    expect(mesh(all).count).toBe(0);
    expect(mesh(all).visible).toBe(false);
  });

  it("counts what is loose of the disc by its place in it", () => {
    const all = made([place(false), place(true), place(false), place(true)]);
    all.show(JOINT, [100, 100, 100, 100], undefined, FAR, 0);
    expect(mesh(all).count).toBe(2);
    all.show(JOINT, [0, 100, 0, 0], undefined, FAR, 0);
    expect(mesh(all).count).toBe(1);
  });

  it("is not seen from another joint", () => {
    const all = made([tuft(0)]);
    all.show("midcarpal", [100], undefined, FAR, 0);
    expect(mesh(all).count).toBe(0);
  });

  it("goes with its own bone", () => {
    const all = made([tuft(3)]);
    const half = Math.SQRT1_2; // a quarter turn about z: +x becomes +y
    all.lay([
      { quaternion: [1, 0, 0, 0], translation_mm: [50, 50, 50] },
      { quaternion: [half, 0, 0, half], translation_mm: [0, 0, 7] },
    ]);
    all.show(JOINT, [100], undefined, FAR, 0);
    const { at } = standing(all, 0);
    expect(at.x).toBeCloseTo(0, 5);
    expect(at.y).toBeCloseTo(3, 5);
    expect(at.z).toBeCloseTo(7, 5);
  });

  it("leans into a mouth that draws it in, and not into one that is far off", () => {
    const all = made([tuft(0)]);
    const towards = (x: number | undefined): number => {
      all.show(JOINT, [100], x === undefined ? undefined : { atMm: [x, 0, 0.5] }, FAR, 0);
      return pointing(all, 0).x;
    };
    const still = towards(undefined);
    expect(towards(1)).toBeGreaterThan(still);
    expect(towards(9)).toBeCloseTo(still, 9);
  });

  it("is made of few triangles, each of them finite", () => {
    for (const [shape, most] of [
      [tuftGeometry(), 700],
      [flapGeometry(), 60],
    ] as const) {
      const { array, count } = shape.getAttribute("position");
      expect(count / 3).toBeLessThanOrEqual(most);
      expect([...array].every(Number.isFinite)).toBe(true);
      expect(shape.getAttribute("lining").count).toBe(count);
    }
  });
});

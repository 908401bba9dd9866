// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The tree finds what trying every triangle finds, also in bones that have moved; lines know where they
// run within a bone. Nothing is timed here, and the balls are as coarse as the question allows: on a busy
// machine the same is found, only later.
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { BoneRays, makeHittable, stretchesWithin } from "./bone_rays";

/** A bumpy ball. */
function ball(x: number, detail = 8): THREE.Mesh {
  const geometry = new THREE.IcosahedronGeometry(8, detail);
  const p = geometry.getAttribute("position");
  for (let i = 0; i < p.count; ++i) {
    const bump = 1 + 0.1 * Math.sin(p.getX(i)) * Math.cos(1.3 * p.getY(i));
    p.setXYZ(i, p.getX(i) * bump, p.getY(i) * bump, p.getZ(i) * bump);
  }
  const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial());
  mesh.position.set(x, 0, 0);
  mesh.updateMatrixWorld(true);
  return mesh;
}

/** Seeded: the same rays each time. */
function rays(count: number): THREE.Ray[] {
  let state = 7;
  const next = (): number => {
    state = (1664525 * state + 1013904223) >>> 0;
    return state / 2 ** 32 - 0.5;
  };
  return Array.from({ length: count }, () => {
    const origin = new THREE.Vector3(100 * next(), 30 * next(), 60);
    const target = new THREE.Vector3(100 * next(), 12 * next(), 6 * next());
    return new THREE.Ray(origin, target.sub(origin).normalize());
  });
}

function points(bones: THREE.Mesh[], lines: readonly THREE.Ray[]): (number[] | undefined)[] {
  const caster = new THREE.Raycaster();
  const out = new THREE.Vector3();
  const boneRays = new BoneRays(bones);
  return lines.map(({ origin, direction }) => {
    caster.set(origin, direction);
    return boneRays.first(caster, out) ? out.toArray() : undefined;
  });
}

describe("BoneRays", () => {
  it("find what trying every triangle finds, in bones that have moved too", () => {
    const bones = [-30, -10, 10, 30].map((x) => ball(x));
    bones[1]?.position.set(-14, 3, 2);
    bones[1]?.quaternion.setFromEuler(new THREE.Euler(0.4, -0.2, 0.9));
    bones[1]?.updateMatrixWorld(true);
    const lines = rays(150);
    const slow = points(bones, lines);
    bones.forEach(makeHittable);
    const fast = points(bones, lines);
    const hit = slow.filter((point) => point !== undefined);
    expect(hit.length).toBeGreaterThan(40);
    expect(hit.length).toBeLessThan(lines.length);
    slow.forEach((point, i) => {
      expect(fast[i] === undefined).toBe(point === undefined);
      point?.forEach((value, axis) => {
        expect(fast[i]?.[axis]).toBeCloseTo(value, 6);
      });
    });
  });
});

describe("stretchesWithin", () => {
  const hittable = (geometry: THREE.BufferGeometry): THREE.BufferGeometry => {
    const mesh = new THREE.Mesh(geometry);
    makeHittable(mesh);
    return geometry;
  };
  const cube = hittable(new THREE.BoxGeometry(4, 4, 4));

  it("are where a line enters and leaves", () => {
    expect(stretchesWithin(cube, [-5, 0.3, 0.2], [1, 0, 0], 20)).toEqual([[3, 7]]);
  });

  it("begin at the line's start and end at its end where these lie within", () => {
    expect(stretchesWithin(cube, [0, 0.3, 0.2], [1, 0, 0], 1.5)).toEqual([[0, 1.5]]);
  });

  it("are none for a line beside the bone or one that ends before it", () => {
    expect(stretchesWithin(cube, [-5, 3, 0], [1, 0, 0], 20)).toEqual([]);
    expect(stretchesWithin(cube, [-5, 0.3, 0.2], [1, 0, 0], 2)).toEqual([]);
  });

  it("count an edge between two triangles once", () => {
    expect(stretchesWithin(cube, [-5, 0, 0], [1, 0, 0], 20)).toEqual([[3, 7]]);
  });

  it("are two through a ring", () => {
    const ring = hittable(new THREE.TorusGeometry(10, 2, 32, 64));
    const found = stretchesWithin(ring, [-20, 0.1, 0.1], [1, 0, 0], 40);
    expect(found.length).toBe(2);
    expect(found[0]?.[0]).toBeCloseTo(8, 1);
    expect(found[1]?.[1]).toBeCloseTo(32, 1);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { insideOut, linedAs } from "./inside_out";

/** Which way a triangle looks, by the order of its corners. */
function facing(geometry: THREE.BufferGeometry, triangle: number): THREE.Vector3 {
  const at = geometry.getAttribute("position");
  const [a, b, c] = [0, 1, 2].map((k) =>
    new THREE.Vector3().fromBufferAttribute(at, 3 * triangle + k),
  ) as [THREE.Vector3, THREE.Vector3, THREE.Vector3];
  return b.sub(a).cross(c.sub(a)).normalize();
}

describe("a shape turned inside out", () => {
  it("has every triangle and every normal the other way round", () => {
    const before = new THREE.SphereGeometry(1, 8, 6).toNonIndexed();
    const after = insideOut(new THREE.SphereGeometry(1, 8, 6));
    expect(after.index).toBeNull();
    const count = after.getAttribute("position").count;
    expect(count).toBe(before.getAttribute("position").count);
    for (let t = 0; 3 * t < count; ++t) {
      expect(facing(after, t).dot(facing(before, t))).toBeCloseTo(-1, 5);
      const outwards = new THREE.Vector3().fromBufferAttribute(
        after.getAttribute("position"),
        3 * t,
      );
      const normal = new THREE.Vector3().fromBufferAttribute(after.getAttribute("normal"), 3 * t);
      expect(normal.dot(outwards)).toBeCloseTo(-1, 5);
    }
  });

  it("keeps a corner's other values with it", () => {
    const shape = new THREE.BufferGeometry();
    shape.setAttribute(
      "position",
      new THREE.Float32BufferAttribute([0, 0, 0, 1, 0, 0, 0, 1, 0], 3),
    );
    shape.setAttribute("normal", new THREE.Float32BufferAttribute([0, 0, 1, 0, 0, 1, 0, 0, 1], 3));
    shape.setAttribute("uv", new THREE.Float32BufferAttribute([0, 0, 1, 0, 0, 1], 2));
    const made = insideOut(shape);
    expect([...made.getAttribute("position").array]).toEqual([0, 0, 0, 0, 1, 0, 1, 0, 0]);
    expect([...made.getAttribute("uv").array]).toEqual([0, 0, 0, 1, 1, 0]);
  });

  it("is lined the same all over, without fibres", () => {
    const disc = linedAs(new THREE.BoxGeometry(), 1).getAttribute("lining");
    for (let v = 0; v < disc.count; ++v)
      expect([disc.getX(v), disc.getY(v), disc.getZ(v), disc.getW(v)]).toEqual([0, 1, 0, 0]);
    const synovium = linedAs(new THREE.BoxGeometry(), undefined);
    expect([...synovium.getAttribute("lining").array].every((w) => w === 0)).toBe(true);
    expect([...synovium.getAttribute("fibre").array].every((w) => w === 0)).toBe(true);
  });
});

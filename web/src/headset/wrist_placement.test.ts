// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { before, carried, enlargedBy, rendererFromRoom } from "./wrist_placement";

const HOME = new THREE.Vector3(0.01, -0.02, 0.03);

function inRoom(placement: ReturnType<typeof before>, x: number, y: number, z: number) {
  const room = rendererFromRoom(placement, HOME).invert();
  return new THREE.Vector3(x, y, z).add(HOME).applyMatrix4(room);
}

describe("placement of the wrist in the room", () => {
  const seated = before(new THREE.Vector3(1, 1.2, 2), new THREE.Vector3(0, -0.5, -1));

  it("lies before the wearer, below the eyes", () => {
    const middle = inRoom(seated, 0, 0, 0);
    expect(middle.x).toBeCloseTo(1);
    expect(middle.y).toBeCloseTo(0.9);
    expect(middle.z).toBeCloseTo(1.55);
  });

  it("dorsum up, fingers away, sides unreflected, life-size", () => {
    const middle = inRoom(seated, 0, 0, 0);
    const dorsal = inRoom(seated, 0, 0, 0.1).sub(middle);
    const distal = inRoom(seated, 0, 0.1, 0).sub(middle);
    const right = inRoom(seated, 0.1, 0, 0).sub(middle);
    expect(dorsal.y).toBeCloseTo(0.1);
    expect(distal.z).toBeCloseTo(-0.1);
    expect(right.x).toBeCloseTo(0.1);
  });

  it("turns with who looks another way", () => {
    const turned = before(new THREE.Vector3(0, 1, 0), new THREE.Vector3(1, 0, 0));
    const distal = inRoom(turned, 0, 0.1, 0).sub(inRoom(turned, 0, 0, 0));
    expect(distal.x).toBeCloseTo(0.1);
    expect(inRoom(turned, 0, 0, 0).x).toBeCloseTo(0.45);
  });

  it("says where the table is to who looks at the ceiling", () => {
    const up = before(new THREE.Vector3(), new THREE.Vector3(0, 1, 0.01));
    expect(up.place.z).toBeCloseTo(-0.45);
  });

  it("is enlarged about its middle, within limits", () => {
    const large = before(new THREE.Vector3(), new THREE.Vector3(0, 0, -1));
    const middle = inRoom(large, 0, 0, 0);
    enlargedBy(large, 2);
    expect(inRoom(large, 0, 0, 0).distanceTo(middle)).toBeCloseTo(0);
    expect(inRoom(large, 0, 0, 0.1).distanceTo(middle)).toBeCloseTo(0.2);
    enlargedBy(large, 100);
    expect(large.enlarged).toBe(4);
    enlargedBy(large, 0.001);
    expect(large.enlarged).toBe(1);
  });

  it("goes with the hand that carries it", () => {
    const table = before(new THREE.Vector3(), new THREE.Vector3(0, 0, -1));
    const middle = inRoom(table, 0, 0, 0);
    carried(table, new THREE.Vector3(0.1, 0, 0), new THREE.Vector3(0.1, 0.2, 0));
    expect(inRoom(table, 0, 0, 0).sub(middle).y).toBeCloseTo(0.2);
  });
});

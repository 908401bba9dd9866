// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { makeFrameMap } from "../frames";
import { before, enlargedBy, rendererFromRoom } from "./wrist_placement";
import { nearer, REACH_M, toolOf } from "./tool_in_hand";

// Wrist frame = Patient: renderer Y = -x, Z = -z, X = -y.
const FRAMES = makeFrameMap([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
const HOME = new THREE.Vector3();

/** A ray from `at` downwards. */
function downwards(at: THREE.Vector3): THREE.Matrix4 {
  return new THREE.Matrix4()
    .makeTranslation(at)
    .multiply(new THREE.Matrix4().makeRotationX(-Math.PI / 2));
}

describe("the instrument that a controller is", () => {
  const placement = before(new THREE.Vector3(0, 1.2, 0), new THREE.Vector3(0, 0, -1));

  it("pointed down from above reaches the middle from dorsal", () => {
    const at = placement.place.clone();
    at.y += REACH_M;
    const { tipMm, shaft } = toolOf(downwards(at), rendererFromRoom(placement, HOME), FRAMES);
    for (const mm of tipMm) expect(mm).toBeCloseTo(0);
    // Dorsal is -z of the wrist.
    expect(shaft[2]).toBeCloseTo(-1);
  });

  it("moves as much in the wrist as in the room, divided by the enlargement", () => {
    for (const factor of [1, 2]) {
      enlargedBy(placement, factor);
      const at = placement.place.clone();
      at.y += REACH_M;
      at.x += 0.01;
      const { tipMm, shaft } = toolOf(downwards(at), rendererFromRoom(placement, HOME), FRAMES);
      expect(Math.hypot(...tipMm)).toBeCloseTo(10 / factor);
      expect(Math.hypot(...shaft)).toBeCloseTo(1);
    }
  });
});

describe("what bone let go of", () => {
  it("goes to the hand, no faster than it may", () => {
    expect(nearer([0, 0, 0], [0, 30, 40], 5)).toEqual([0, 3, 4]);
    expect(nearer([0, 0, 0], [0, 3, 4], 6)).toEqual([0, 3, 4]);
    expect(nearer([1, 2, 3], [1, 2, 3], 0)).toEqual([1, 2, 3]);
  });
});

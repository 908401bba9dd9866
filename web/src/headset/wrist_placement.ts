// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the wrist lies in the room of whoever wears the headset: on a hand table before them, dorsum up,
// fingers away. Room: metres, Y up. Renderer: metres, Y distal, Z dorsal (frames/). Pure.
import * as THREE from "three";

/** Before the eyes and below them [m]: a hand table, seated. */
const AHEAD_M = 0.45;
const BELOW_M = 0.3;
/** Life-size to the enlargement of loupes and beyond. */
export const LEAST_ENLARGED = 1;
export const MOST_ENLARGED = 4;

export interface Placement {
  /** Where the middle of what is operated on lies [m]. */
  readonly place: THREE.Vector3;
  /** About the room's vertical [rad]; 0: the wearer looks along -Z, the fingers point there. */
  yawRad: number;
  /** Size in the room over size in life. */
  enlarged: number;
}

const UP = new THREE.Vector3(0, 1, 0);

/** Before a wearer whose eyes are at `eye` and look along `forward`. */
export function before(eye: THREE.Vector3, forward: THREE.Vector3): Placement {
  const level = new THREE.Vector3(forward.x, 0, forward.z);
  // Straight up or down says nothing of where the table is.
  if (level.length() < 0.1) level.set(0, 0, -1);
  level.normalize();
  const place = eye.clone().addScaledVector(level, AHEAD_M);
  place.y -= BELOW_M;
  return { place, yawRad: Math.atan2(-level.x, -level.z), enlarged: 1 };
}

export function enlargedBy(placement: Placement, factor: number): void {
  const wanted = placement.enlarged * factor;
  placement.enlarged = Math.min(MOST_ENLARGED, Math.max(LEAST_ENLARGED, wanted));
}

/** @param home  the middle of what is operated on, in the renderer's frame [m] */
export function rendererFromRoom(placement: Placement, home: THREE.Vector3): THREE.Matrix4 {
  const { place, yawRad, enlarged } = placement;
  const dorsumUp = new THREE.Matrix4().makeRotationX(-Math.PI / 2);
  return new THREE.Matrix4()
    .makeTranslation(place)
    .multiply(new THREE.Matrix4().makeRotationAxis(UP, yawRad))
    .multiply(dorsumUp)
    .multiply(new THREE.Matrix4().makeScale(enlarged, enlarged, enlarged))
    .multiply(new THREE.Matrix4().makeTranslation(-home.x, -home.y, -home.z))
    .invert();
}

/** The table goes with the hand that took hold of it; it stays level. */
export function carried(placement: Placement, from: THREE.Vector3, to: THREE.Vector3): void {
  placement.place.add(to).sub(from);
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The instrument that a controller is: its tip lies ahead on the controller's ray, its shaft comes back to
// the hand. Frame Patient, mm. Pure.
import * as THREE from "three";
import type { FrameMap } from "../frames";
import type { Vec3 } from "../protocol";

/** From the hand to the tip, in the room [m]: a wire driver's. */
export const REACH_M = 0.12;

export interface HeldTool {
  readonly tipMm: Vec3;
  /** Unit, from the tip towards the hand. */
  readonly shaft: Vec3;
}

/**
 * @param ray  the controller's target ray in the room: along its -Z
 * @param rendererFromRoom  rigid but for its scale
 */
export function toolOf(
  ray: THREE.Matrix4,
  rendererFromRoom: THREE.Matrix4,
  frames: FrameMap,
): HeldTool {
  const inRenderer = rendererFromRoom.clone().multiply(ray);
  const tip = new THREE.Vector3(0, 0, -REACH_M).applyMatrix4(inRenderer);
  const back = new THREE.Vector3(0, 0, 1).transformDirection(inRenderer);
  return {
    tipMm: frames.pointToPatient(tip.x, tip.y, tip.z),
    shaft: frames.directionToPatient(back.x, back.y, back.z),
  };
}

/** From one place towards another, at most so far [mm]: what bone let go of does not leap to the hand. */
export function nearer(from: Vec3, to: Vec3, mostMm: number): Vec3 {
  const way = [to[0] - from[0], to[1] - from[1], to[2] - from[2]] as const;
  const mm = Math.hypot(...way);
  if (!(mm > mostMm)) return to;
  const share = mostMm / mm;
  return [from[0] + way[0] * share, from[1] + way[1] * share, from[2] + way[2] * share];
}

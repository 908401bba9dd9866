// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The instrument in the hand: an anchor, mostly a point of a bone under the pointer, a distance of
// the tip from it along the shaft, and the shaft. Frame Patient, mm. Pure: every change is a new
// value, so that a step that the host refuses leaves nothing behind.
import type { Vec3 } from "../protocol";
import { add, dot, normalized, rotated, scaled, subtract } from "./vectors";

export interface ToolPose {
  readonly anchorMm: Vec3;
  /**
   * Distance of the tip from the anchor, towards the hand. Zero lays the tip against the bone; negative,
   * where skin is pressed or gone through, it is so far beyond.
   */
  readonly approachMm: number;
  /** Unit vector from the tip towards the hand. */
  readonly shaft: Vec3;
}

/** How far the hand may draw back from the anchor: beyond it nothing is left to see. */
export const MAX_APPROACH_MM = 60;
/** At the anchor the hand's target lies this deep in the bone, so that the tip really touches though
 * the drawn surface and the host's differ by some hundredths of a millimetre. Not more: friction
 * holds a pressed tip, and a step of 0.1 mm is to move it. */
export const PRESS_MM = 0.15;

/** Where the tip is asked to be [mm]. */
export function tipTarget(pose: ToolPose): Vec3 {
  const along = pose.approachMm > 0 ? pose.approachMm : pose.approachMm - PRESS_MM;
  return add(pose.anchorMm, scaled(pose.shaft, along));
}

export function movedBy(pose: ToolPose, deltaMm: Vec3): ToolPose {
  return { ...pose, anchorMm: add(pose.anchorMm, deltaMm) };
}

/** @param deepestMm  that it may go beyond the anchor */
export function approachedBy(pose: ToolPose, deltaMm: number, deepestMm = 0): ToolPose {
  // A tenth of a micrometre: what is left of tenths of a millimetre that do not sum to zero.
  const wanted = Math.round((pose.approachMm + deltaMm) * 1e4) / 1e4;
  return { ...pose, approachMm: Math.min(MAX_APPROACH_MM, Math.max(0 - deepestMm, wanted)) };
}

/** The tip came no farther: the hand gives way and is not farther ahead of it along the shaft. */
export function heldBackTo(pose: ToolPose, tipMm: Vec3, mostAheadMm: number): ToolPose {
  const least = dot(subtract(tipMm, pose.anchorMm), pose.shaft) - mostAheadMm;
  return pose.approachMm >= least ? pose : { ...pose, approachMm: least };
}

/** Turns the shaft about the tip. @param axis unit vector. */
export function turnedBy(pose: ToolPose, axis: Vec3, angleRad: number): ToolPose {
  return { ...pose, shaft: normalized(rotated(pose.shaft, axis, angleRad), pose.shaft) };
}

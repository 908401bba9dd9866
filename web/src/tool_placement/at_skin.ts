// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A hand at closed skin, which nobody feels here: it begins before it and gives way to what holds its instrument.
import type { Vec3 } from "../protocol";
import { heldBackTo, MAX_APPROACH_MM, type ToolPose } from "./tool_pose";
import { dot, subtract } from "./vectors";

/** Pressed on closed skin or led through it, so far beyond where the tip was laid [mm]. */
export const DEEPEST_MM = 45;
const BEFORE_SKIN_MM = 12;
/** Nobody feels here what holds a needle, a clamp or a sheath: at 2 N a mm it is pressed by no more than 12 N, over
 * the 9 that a clamp needs to go through the capsule. A key that draws it back draws it back at once. */
const MOST_AHEAD_MM = 6;

/**
 * What is taken anew begins before the skin, not in it: it would prick before it was placed.
 * @param hadTipMm  of what the hand put down for it: after a reload the page may know of a scope's place in the joint
 *     alone, and begins no deeper than that was drawn out to
 */
export function begunBeforeSkin(pose: ToolPose, hadTipMm: Vec3 | undefined): ToolPose {
  const out = hadTipMm === undefined ? 0 : dot(subtract(hadTipMm, pose.anchorMm), pose.shaft);
  const least = Math.min(MAX_APPROACH_MM, Math.max(BEFORE_SKIN_MM, out));
  return pose.approachMm >= least ? pose : { ...pose, approachMm: least };
}

/** What is held by what it went through comes no farther than that lets it. */
export function givenWay(pose: ToolPose, tipMm: Vec3): ToolPose {
  return heldBackTo(pose, tipMm, MOST_AHEAD_MM);
}

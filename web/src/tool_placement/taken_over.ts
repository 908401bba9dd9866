// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a hand begins as it takes over what the host has it hold, or nothing. Pure.
import type { Vec3 } from "../protocol";
import { MAX_APPROACH_MM, type ToolPose } from "./tool_pose";
import { add, dot, normalized, scaled, subtract } from "./vectors";

/** An empty hand begins so far beside the middle, to the right of the screen. */
const BESIDE_MM = 30;

/** Before anything was taken over. */
export const NOWHERE: ToolPose = {
  anchorMm: [0, 0, 0],
  approachMm: MAX_APPROACH_MM,
  shaft: [0, 0, 1],
};

/**
 * Drawn back from the level of what is operated on, so that it can be advanced to there.
 * @param middleMm  of what is operated on
 * @param isAtBone  its tip is in a bone, or just came out: that is where it begins
 */
export function takenOver(
  item: { readonly tip_mm: Vec3; readonly shaft: Vec3 },
  middleMm: Vec3,
  isAtBone: boolean,
): ToolPose {
  const shaft = normalized(item.shaft);
  const above = isAtBone ? 0 : dot(subtract(item.tip_mm, middleMm), shaft);
  const approachMm = Math.min(MAX_APPROACH_MM, Math.max(0, above));
  return { anchorMm: subtract(item.tip_mm, scaled(shaft, approachMm)), approachMm, shaft };
}

/** @param right  on the screen @param shaft  of the other hand */
export function emptyHanded(middleMm: Vec3, right: Vec3, shaft: Vec3): ToolPose {
  return {
    anchorMm: add(middleMm, scaled(right, BESIDE_MM)),
    approachMm: MAX_APPROACH_MM,
    shaft: normalized(shaft),
  };
}

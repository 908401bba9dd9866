// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wished of the wrist: within its limits, in whole steps where it can be.
import type { WristAxis } from "../operation";
import type { WristLimits, WristPose } from "../protocol";

export const REST: WristPose = {
  flexion_deg: 0,
  radial_deviation_deg: 0,
  pronation_deg: 0,
  traction_n: 0,
};

/** @param by  degrees or newtons; never beyond the limits */
export function nudged(
  pose: WristPose,
  limits: WristLimits,
  axis: WristAxis,
  by: number,
): WristPose {
  const { low, high } = limits[axis];
  return { ...pose, [axis]: Math.min(high, Math.max(low, pose[axis] + by)) };
}

export function within(pose: WristPose, limits: WristLimits): WristPose {
  const kept = (axis: WristAxis): number =>
    Math.min(limits[axis].high, Math.max(limits[axis].low, pose[axis]));
  return {
    flexion_deg: kept("flexion_deg"),
    radial_deviation_deg: kept("radial_deviation_deg"),
    pronation_deg: kept("pronation_deg"),
    traction_n: kept("traction_n"),
  };
}

/** "−12°", "15 N". */
export function readingText(axis: WristAxis, value: number): string {
  const whole = Math.round(value);
  const signed = `${whole < 0 ? "−" : ""}${Math.abs(whole)}`;
  return axis === "traction_n" ? `${signed} N` : `${signed}°`;
}

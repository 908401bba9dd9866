// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A view that waits until the hand is held for it; given up where the hand does not go. Pure.
import type { NamedView, WristPose } from "../protocol";

/** The hand has come to how a view wants it [deg]; or has not moved for so long. */
const HELD_WITHIN_DEG = 1.5;
const HELD_PATIENCE_MS = 1500;
const STILL_DEG = 0.1;

export class ViewWait {
  private movedAtMs: number;
  private pose: WristPose | undefined;

  constructor(
    readonly view: NamedView,
    nowMs: number,
  ) {
    this.movedAtMs = nowMs;
  }

  /** Whether a view has a wish for the hand at all. */
  static isWanted({ flexion_deg, radial_deviation_deg }: NamedView): boolean {
    return flexion_deg !== null || radial_deviation_deg !== null;
  }

  see(now: WristPose, nowMs: number): "waits" | "held" | "given_up" {
    const { flexion_deg, radial_deviation_deg } = this.view;
    const away = Math.max(
      flexion_deg === null ? 0 : Math.abs(flexion_deg - now.flexion_deg),
      radial_deviation_deg === null ? 0 : Math.abs(radial_deviation_deg - now.radial_deviation_deg),
    );
    if (away < HELD_WITHIN_DEG) return "held";
    const { pose } = this;
    const isStill =
      pose !== undefined &&
      Math.abs(pose.flexion_deg - now.flexion_deg) +
        Math.abs(pose.radial_deviation_deg - now.radial_deviation_deg) <
        STILL_DEG;
    if (!isStill) {
      this.pose = now;
      this.movedAtMs = nowMs;
      return "waits";
    }
    return nowMs - this.movedAtMs > HELD_PATIENCE_MS ? "given_up" : "waits";
  }
}

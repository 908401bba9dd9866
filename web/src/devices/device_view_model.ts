// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A device's right and up are the screen's. When the view was turned and rests again, the host is told;
// while it turns, the tip would slip under the hand. Pure but for the clock that is given.
import type { Vec3 } from "../protocol";

export interface Axes {
  readonly right: Vec3;
  readonly up: Vec3;
}

/** Less than this is the same view: one degree. */
const SAME = Math.cos(Math.PI / 180);
const RESTS_MS = 300;

const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function isSame(a: Axes, b: Axes): boolean {
  return dot(a.right, b.right) > SAME && dot(a.up, b.up) > SAME;
}

export class DeviceView {
  private told: Axes | undefined;
  private seen: Axes | undefined;
  private seenMs = 0;

  /** It was told with a choice. */
  tell(axes: Axes): void {
    this.told = this.seen = axes;
  }

  /** Asked several times a second. @return whether the host is to be told these axes now */
  turned(axes: Axes, nowMs: number): boolean {
    if (this.told === undefined) return false;
    if (this.seen === undefined || !isSame(axes, this.seen)) {
      this.seen = axes;
      this.seenMs = nowMs;
    }
    if (isSame(axes, this.told) || nowMs - this.seenMs < RESTS_MS) return false;
    this.told = axes;
    return true;
  }
}

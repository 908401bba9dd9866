// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The host's last snapshot, and all that shows it: the theatre at once, readings ten times a second.
import { whyStuck } from "../operation";
import type { Screw, SnapshotMessage } from "../protocol";
import type { Theatre } from "../theatre";
import type { Hand } from "./hand";
import type { Panels } from "./panels";

export class WhatIsSeen {
  private snapshot: SnapshotMessage | undefined;

  constructor(
    private readonly panels: Panels,
    private readonly theatre: Theatre,
    private readonly screws: readonly Screw[],
  ) {}

  get latest(): SnapshotMessage | undefined {
    return this.snapshot;
  }

  take(s: SnapshotMessage): void {
    const screw = this.screws.find((one) => one.index === s.screw_index);
    if (screw !== undefined && s.screw_index !== this.snapshot?.screw_index)
      this.theatre.setScrewShape(screw);
    this.snapshot = s;
    this.theatre.show(s);
    this.panels.bottom.sample(s);
    this.panels.steps.show(s);
  }

  /** @param operates  whether this page does: only then is a pause said over the scene */
  showReadings(hand: Hand, operates: boolean): void {
    const s = this.snapshot;
    if (s === undefined) return;
    const { arm, bottom, frozen, notice, pausedSign, top } = this.panels;
    top.showTiming(s);
    pausedSign.hidden = !s.paused || !operates || !frozen.hidden;
    bottom.show(s, hand.driver, hand.thrust);
    arm.showCount(s.shots, s.dose_cgy_cm2);
    const stuck = hand.driver === "forward" ? whyStuck(s, hand.thrust) : undefined;
    if (stuck !== undefined) notice.say(stuck);
  }

  /** Log and pictures of an exercise that is over. */
  clearRecord(): void {
    this.panels.steps.clearLog();
    this.panels.arm.clear();
  }

  /** Another exercise: nothing of it was seen yet. */
  forget(): void {
    this.clearRecord();
    this.snapshot = undefined;
  }
}

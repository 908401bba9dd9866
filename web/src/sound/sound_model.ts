// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is heard, of what the host tells and what the hand does: the driver's motor, whose pitch falls under
// load and leaps when the tip breaks through; a click for each half turn of a screw; the C-arm's tone
// while it shines; knocks while something presses too hard in a joint. Pure: one moment after the other.
import type { Drive, Driver } from "../protocol";

export interface Heard {
  readonly nowMs: number;
  readonly driver: Driver;
  /** Who turns what is held; "none" for an empty hand. */
  readonly drive: Drive;
  /** Of bone along the shaft [N]. */
  readonly resistanceN: number;
  /** That turning a screw takes [N mm]. */
  readonly torqueNMm: number;
  /** How deep it is in bone [mm]. */
  readonly depthMm: number;
  /** Of a thread [mm]; 0 for none. */
  readonly pitchMm: number;
  /** The pedal is down. */
  readonly live: boolean;
  readonly shots: number;
  /** In a joint: of which the page warns, and what does harm. */
  readonly press: Press;
}

export type Press = "none" | "hard" | "harm";

export interface Sounds {
  /** Of the motor [Hz]; 0 while it rests. */
  readonly motorHz: number;
  /** 0 to 1: how hard it works. */
  readonly load: number;
  readonly clicks: number;
  /** 0 to 1: how tight the screw is that clicks. */
  readonly tightness: number;
  readonly beeps: boolean;
  /** A single picture was taken since. */
  readonly shot: boolean;
  /** Of a press that is too hard; how harmful, 0 to 1. */
  readonly knock: number | undefined;
}

/** Engineering values: a wire driver at about a thousand turns a minute, by ear. */
const FREE_HZ = 330;
const LOADED_SHARE = 0.42;
/** At this resistance it labours as much as it can [N]. */
const FULL_LOAD_N = 45;
/** At this torque a screw is as tight as it gets [N mm]. */
const FULL_TORQUE_N_MM = 160;
/** How slowly the motor gives in, and comes up again [ms]. */
const SLOWS_MS = 90;
const LEAPS_MS = 35;
/** Once bone gives way it races by this share for a moment. */
const RACES = 0.12;
const RACE_MS = 160;
const GIVES_WAY_N = 8;
/** It knocks so often [ms]. */
const KNOCKS_MS: Readonly<Record<Exclude<Press, "none">, number>> = { hard: 450, harm: 180 };
/** More at once is no turning: another instrument, undo. */
const MOST_CLICKS = 4;

export class SoundModel {
  private load = 0;
  private resistanceN = 0;
  private racedAtMs = -Infinity;
  private last: Heard | undefined;
  private halfTurns = 0;
  private knockedAtMs = -Infinity;

  hear(now: Heard): Sounds {
    const { last } = this;
    this.last = now;
    const isRunning = now.driver !== "off" && now.drive === "powered";
    const passedMs = last === undefined ? 0 : Math.max(0, now.nowMs - last.nowMs);
    const wanted = Math.min(1, now.resistanceN / FULL_LOAD_N);
    const slowness = wanted > this.load ? SLOWS_MS : LEAPS_MS;
    this.load += (wanted - this.load) * (1 - Math.exp(-passedMs / slowness));
    if (!isRunning) this.load = 0;
    if (isRunning && this.resistanceN - now.resistanceN > GIVES_WAY_N) this.racedAtMs = now.nowMs;
    this.resistanceN = now.resistanceN;
    const races = now.nowMs - this.racedAtMs < RACE_MS ? RACES : 0;
    const way = now.driver === "reverse" ? 0.9 : 1;
    const shots = last === undefined ? 0 : now.shots - last.shots;
    return {
      motorHz: isRunning ? FREE_HZ * way * (1 - LOADED_SHARE * this.load + races) : 0,
      load: this.load,
      clicks: this.clicksOf(now, last),
      tightness: Math.min(1, now.torqueNMm / FULL_TORQUE_N_MM),
      beeps: now.live,
      shot: shots === 1 && !now.live,
      knock: this.knockOf(now),
    };
  }

  private knockOf({ press, nowMs }: Heard): number | undefined {
    if (press === "none" || nowMs - this.knockedAtMs < KNOCKS_MS[press]) return undefined;
    this.knockedAtMs = nowMs;
    return press === "harm" ? 1 : 0;
  }

  /** Half turns since the moment before, in or out. */
  private clicksOf(now: Heard, last: Heard | undefined): number {
    const isTurning = now.drive === "by_hand" && now.driver !== "off" && now.pitchMm > 0;
    const halfTurns = now.pitchMm > 0 ? Math.floor((2 * now.depthMm) / now.pitchMm) : 0;
    const clicks = Math.abs(halfTurns - this.halfTurns);
    this.halfTurns = halfTurns;
    return last !== undefined && isTurning && clicks <= MOST_CLICKS ? clicks : 0;
  }
}

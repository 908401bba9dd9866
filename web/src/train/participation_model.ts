// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which of the host's exercises this page takes part in, and what the host's welcome means for it.

export type Arrival =
  /** The exercise that this page asked for has begun. */
  | "begun"
  /** This page's exercise waits for it, after a lost connection. */
  | "goes_on"
  /** This page's exercise is over and none runs. */
  | "ended"
  /** This page's exercise is over and another runs. */
  | "replaced"
  /** One that this page began waits for it, after a reload. */
  | "offered"
  /** This page has none; another page's stands still, which this one can only end by its own. */
  | "foreign"
  /** This page has none and none runs. */
  | "free";

export class Participation {
  private own = 0;
  private waiting = 0;
  private foreign = 0;
  private asked = false;

  /** Whether this page operates. */
  get operates(): boolean {
    return this.own !== 0 || this.asked;
  }

  /** Whether a start ends an exercise that stands still. */
  get endsOne(): boolean {
    return this.waiting !== 0 || this.foreign !== 0;
  }

  /** Whether an exercise waits that this page may go on with. */
  get isOffered(): boolean {
    return this.waiting !== 0;
  }

  /** The page has asked for a new exercise. */
  ask(): void {
    this.asked = true;
    this.waiting = this.foreign = 0;
  }

  /** The page goes on with the one that waits. */
  goOn(): void {
    this.own = this.waiting;
    this.waiting = 0;
  }

  /** The page's exercise is finished. */
  finish(): void {
    this.own = 0;
    this.asked = false;
  }

  /** The connection is lost: what was offered may be gone. */
  lose(): void {
    this.waiting = this.foreign = 0;
  }

  /**
   * @param exercise  number in the host's welcome, 0 when none runs
   * @param isOwn     whether this page began it
   */
  arrive(exercise: number, isOwn: boolean): Arrival {
    const begun = this.asked && isOwn && exercise !== 0 && exercise !== this.own;
    const asked = this.asked;
    this.asked = false;
    if (begun) {
      this.own = exercise;
      return "begun";
    }
    if (this.own !== 0 && exercise === this.own) return "goes_on";
    const had = this.own !== 0;
    this.own = 0;
    this.waiting = isOwn ? exercise : 0;
    this.foreign = isOwn ? 0 : exercise;
    if (had) return exercise === 0 ? "ended" : "replaced";
    // What was asked for got lost on the way: the page asks again.
    if (asked || exercise === 0) return "free";
    return isOwn ? "offered" : "foreign";
  }
}

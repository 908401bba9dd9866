// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// States of a replay as they come, stretch by stretch, and which are wanted next. The host tells
// bodies, removed bone and the scope only where they changed within a stretch; here every state has them.
import type {
  BodyPose,
  HostMessage,
  ScopeMessage,
  SkinMessage,
  SnapshotMessage,
  Track,
} from "../protocol";

export interface ReplayState {
  readonly snapshot: SnapshotMessage;
  readonly bodies: readonly BodyPose[];
  readonly tracks: readonly Track[];
  /** Of an arthroscopy, while a hand holds a scope. */
  readonly scope: ScopeMessage | undefined;
  /** By sheet, of the messages `sheet`. */
  readonly sheetsUm: ReadonlyMap<number, readonly number[]>;
  /** Of a procedure that works on closed skin. */
  readonly skin: SkinMessage | undefined;
}

export interface Stretch {
  readonly from: number;
  readonly to: number;
  readonly every: number;
}

/** About thirty states a second of the watcher's time. */
const STATE_MS = 33;
/** A stretch is so much of the watcher's time; the next is asked for when less than this is left. */
const STRETCH_MS = 1300;
/** Of the host's limits (ReplayDesk). */
const MOST_TICKS = 60_000;
const MOST_KEPT = 400;

export function statesOf(messages: readonly HostMessage[]): ReplayState[] {
  let bodies: readonly BodyPose[] = [];
  let tracks: readonly Track[] = [];
  let scope: ScopeMessage | undefined;
  let sheetsUm: ReadonlyMap<number, readonly number[]> = new Map();
  let skin: SkinMessage | undefined;
  const states: ReplayState[] = [];
  for (const message of messages) {
    if (message.type === "tissue") tracks = message.tracks;
    if (message.type === "scope") scope = message;
    if (message.type === "sheet") sheetsUm = new Map(sheetsUm).set(message.sheet, message.off_um);
    if (message.type === "skin") skin = message;
    const last = states.at(-1);
    // They come after the snapshot that they belong to.
    const belongs = message.type === "scope" || message.type === "sheet" || message.type === "skin";
    if (last !== undefined && belongs)
      states[states.length - 1] = { ...last, scope, sheetsUm, skin };
    if (message.type !== "snapshot") continue;
    bodies = message.bodies ?? bodies;
    states.push({ snapshot: message, bodies, tracks, scope, sheetsUm, skin });
  }
  return states;
}

export class ReplayBuffer {
  private states: ReplayState[] = [];
  private every = 0;
  /** Up to where there are states. */
  private to = -1;

  constructor(private readonly length: number) {}

  /** The newest state that is not after `tick`, where the stretches that are there hold it. */
  at(tick: number): ReplayState | undefined {
    const first = this.states[0]?.snapshot.tick;
    if (first === undefined || tick < first || tick >= this.to + Math.max(1, this.every)) {
      return undefined;
    }
    return this.states.filter((state) => state.snapshot.tick <= tick).at(-1);
  }

  /** What is to be asked for next; undefined while there is enough. */
  wanted(tick: number, speed: number, plays: boolean): Stretch | undefined {
    const here = this.at(tick);
    if (!plays) {
      // Standing still, the very moment is shown, not the one of 30 ms before.
      if (here?.snapshot.tick === tick) return undefined;
      return { from: tick, to: tick, every: 1 };
    }
    const every = Math.max(1, Math.round(STATE_MS * speed));
    const goesOn = here !== undefined && this.every === every;
    if (goesOn && this.to - tick > (STRETCH_MS * speed) / 2) return undefined;
    const from = goesOn ? this.to + every : tick;
    if (from > this.length) return undefined;
    const ticks = Math.min(MOST_TICKS, STRETCH_MS * speed);
    const to = from + Math.floor(ticks / every) * every;
    return { from, to, every };
  }

  add(stretch: Stretch, states: readonly ReplayState[]): void {
    const follows = stretch.every === this.every && stretch.from === this.to + this.every;
    this.states = follows ? [...this.states, ...states].slice(-MOST_KEPT) : [...states];
    this.every = stretch.every;
    this.to = stretch.to;
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is held down by keys, by buttons of the page or of a gamepad: which of it drives, and by how much the
// rest has gone on since it was asked last.
import type { HeldAction } from "../operation";
import type { HandMessage } from "../protocol";
import { keySteps, stepsAfter, type KeyStep } from "../tool_placement";

const ORBIT_STEP_RAD = (2 * Math.PI) / 180;
const ORBIT_STEPS_PER_S = 45;
const WRIST_STEP = 1;
const WRIST_STEPS_PER_S = 60;

/** Goes on step by step for as long as it is held. */
export type SteppedAction = Exclude<HeldAction, { readonly kind: "drive" }>;

interface Held {
  readonly action: HeldAction;
  readonly sinceMs: number;
  done: number;
}

function stepOf(kind: SteppedAction["kind"], isCoarse: boolean): KeyStep {
  const { move, turn } = keySteps(isCoarse);
  switch (kind) {
    case "turn_shaft":
      return turn;
    case "move_wrist":
      return { size: WRIST_STEP, fastest: WRIST_STEPS_PER_S };
    case "orbit":
      return { size: ORBIT_STEP_RAD, fastest: ORBIT_STEPS_PER_S };
    default:
      return move;
  }
}

type Go = (action: SteppedAction, by: number) => void;

function walk(held: Held, nowMs: number, isCoarse: boolean, go: Go): void {
  const { action } = held;
  if (action.kind === "drive") return;
  const { size, fastest } = stepOf(action.kind, isCoarse);
  const due = stepsAfter((nowMs - held.sinceMs) / 1000, fastest);
  const by = (due - held.done) * size;
  if (by <= 0) return;
  held.done = due;
  go(action, by);
}

export class HeldDown {
  private readonly held = new Map<string, Held>();

  has(holder: string): boolean {
    return this.held.has(holder);
  }

  begin(holder: string, action: HeldAction, nowMs: number): void {
    this.held.set(holder, { action, sinceMs: nowMs, done: 0 });
  }

  /**
   * A tap between two frames still counts.
   * @return what was held; undefined where nothing was
   */
  letGo(holder: string, nowMs: number, isCoarse: boolean, go: Go): HeldAction | undefined {
    const held = this.held.get(holder);
    if (held === undefined) return undefined;
    walk(held, nowMs, isCoarse, go);
    this.held.delete(holder);
    return held.action;
  }

  letGoOf(isMeant: (action: HeldAction) => boolean): void {
    for (const [code, { action }] of this.held) if (isMeant(action)) this.held.delete(code);
  }

  clear(): void {
    this.held.clear();
  }

  /** @param go  what each has gone on by since the last time */
  walk(nowMs: number, isCoarse: boolean, go: Go): void {
    for (const held of this.held.values()) walk(held, nowMs, isCoarse, go);
  }

  get driver(): HandMessage["driver"] {
    for (const { action } of this.held.values()) {
      if (action.kind === "drive") return action.driver;
    }
    return "off";
  }
}

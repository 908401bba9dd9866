// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What works beside the scope: a probe, forceps whose jaws lock, or a shaver with pedal and mouth, by hand.
import type { ExerciseMessage, HandMessage, Item, ScopeMessage, Vec3 } from "../protocol";
import { cross, dot, normalized, rotated, scaled, subtract } from "../tool_placement";
import { wrappedDeg } from "./scope_hand_model";
import type { HandIndex } from "./scope_hands";
import { rodLook, type RodLook } from "./scope_rod";

export type ToolKind = "probe" | "grasper" | "shaver";

/** As the picture draws it. */
export interface Rod {
  readonly tipMm: Vec3;
  readonly shaft: Vec3;
  readonly look: RodLook;
  /** Unit: where a shaver's mouth looks. */
  readonly mouth: Vec3 | undefined;
}

export class ScopeTools {
  private readonly areClosed: [boolean, boolean] = [false, false];
  private readonly mouthDeg: [number, number] = [0, 0];
  private jaws: ReadonlySet<string> = new Set();
  private mouths: ReadonlySet<string> = new Set();

  begin(exercise: ExerciseMessage): void {
    const ids = (has: "has_jaws" | "has_mouth"): ReadonlySet<string> =>
      new Set(exercise.instruments.filter((one) => one[has]).map((one) => one.id));
    this.jaws = ids("has_jaws");
    this.mouths = ids("has_mouth");
    this.areClosed.fill(false);
    this.mouthDeg.fill(0);
  }

  /** Of the exercise. */
  get kind(): ToolKind {
    if (this.jaws.size > 0) return "grasper";
    return this.mouths.size > 0 ? "shaver" : "probe";
  }

  /** As the host has them: a page that comes back must not open what holds something. */
  take(scope: ScopeMessage | undefined, isHeld: (hand: HandIndex) => boolean): void {
    for (const hand of [0, 1] as const) {
      this.areClosed[hand] = isHeld(hand) && scope?.jaws_closed[hand] === 1;
      this.mouthDeg[hand] = scope?.mouth_deg[hand] ?? 0;
    }
  }

  hasJaws(instrument: string): boolean {
    return this.jaws.has(instrument);
  }

  hasMouth(instrument: string | undefined): boolean {
    return instrument !== undefined && this.mouths.has(instrument);
  }

  /** @param closed  undefined: the other way than now. @returns  whether that is another way */
  setJaws(hand: HandIndex, closed: boolean | undefined): boolean {
    const before = this.areClosed[hand];
    this.areClosed[hand] = closed ?? !before;
    return this.areClosed[hand] !== before;
  }

  /** @returns  how the mouth is turned then */
  turnMouth(hand: HandIndex, byDeg: number): number {
    this.mouthDeg[hand] = wrappedDeg(this.mouthDeg[hand] + byDeg);
    return this.mouthDeg[hand];
  }

  /** Jaws lock: they close by one way of the driver, and open by the other. A shaver runs by the pedal. */
  driver(hand: HandIndex, pedalIsDown: boolean): HandMessage["driver"] {
    if (this.kind === "grasper") return this.areClosed[hand] ? "forward" : "reverse";
    return this.kind === "shaver" && pedalIsDown ? "forward" : "off";
  }

  /** @param level  up in a level picture. @param nowMs  a running blade turns by it; the same where nothing is to move */
  rod(item: Item, scope: ScopeMessage, level: Vec3, nowMs: number): Rod {
    const hand = item.hand === 1 ? 1 : 0;
    const runs = scope.running[hand] === 1;
    const look = this.hasMouth(item.instrument)
      ? shaverLook(runs, nowMs)
      : rodLook(this.hasJaws(item.instrument), scope.jaws_closed[hand] === 1);
    const mouth = this.hasMouth(item.instrument)
      ? mouthTowards(item.shaft, level, scope.mouth_deg[hand] ?? 0)
      : undefined;
    return { tipMm: item.tip_mm, shaft: item.shaft, look, mouth };
  }
}

/** The blade oscillates: it opens and shuts the window. */
const BLADE_MS = 90;
function shaverLook(runs: boolean, nowMs: number): RodLook {
  return runs && Math.floor(nowMs / BLADE_MS) % 2 === 1 ? "blade" : "shaver";
}

/** As the host has it: at 0 towards what is level, turning right-handed about the shaft. */
export function mouthTowards(shaft: Vec3, level: Vec3, turnDeg: number): Vec3 {
  const across = subtract(level, scaled(shaft, dot(level, shaft)));
  const flat =
    Math.hypot(...across) > 1e-6 ? normalized(across) : normalized(cross(shaft, [1, 0, 0]));
  return rotated(flat, shaft, (turnDeg * Math.PI) / 180);
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The measures on a scan, and the one that is being laid place by place; says what it does in words.
import { isWhole, measureText, type Measure, type MeasureKind } from "./measure_model";
import type { Vec3 } from "../protocol";

export class MeasureTool {
  private all: readonly Measure[] = [];
  private held: MeasureKind | undefined;

  get measures(): readonly Measure[] {
    return this.all;
  }

  /** What is in the hand. */
  get kind(): MeasureKind | undefined {
    return this.held;
  }

  /** Takes it, or puts it down where it is held. @return what to say */
  toggle(kind: MeasureKind): string {
    this.held = this.held === kind ? undefined : kind;
    this.all = this.all.filter(isWhole);
    if (this.held === undefined) return "";
    const what = kind === "distance" ? "its two ends" : "three places, the corner second";
    return `Click ${what}; Esc puts down.`;
  }

  /** @return what to say; undefined where it goes on */
  add(mm: Vec3): string | undefined {
    const kind = this.held;
    if (kind === undefined) return undefined;
    const last = this.all.at(-1);
    const goesOn = last !== undefined && !isWhole(last);
    const now: Measure = { kind, places: goesOn ? [...last.places, mm] : [mm] };
    this.all = [...(goesOn ? this.all.slice(0, -1) : this.all), now];
    if (!isWhole(now)) return undefined;
    return `${kind === "distance" ? "Distance" : "Angle"} ${measureText(now)}`;
  }

  dropLast(): void {
    this.all = this.all.slice(0, -1);
  }

  putDown(): void {
    this.held = undefined;
    this.all = this.all.filter(isWhole);
  }
}

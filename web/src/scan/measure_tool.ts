// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The measures on a scan, and the one that is being laid place by place; says what it does in words.
import type { Vec3 } from "../protocol";
import { isWhole, measureText, type Measure, type MeasureKind } from "./measure_model";
import type { Volume } from "./nifti_model";
import { measureRegion, regionOf, regionText } from "./region_model";

const HOW: Readonly<Record<MeasureKind, string>> = {
  distance: "Click its two ends",
  angle: "Click three places, the corner second",
  region: "Drag a circle from its middle to its rim",
};
/** A circle that is smaller was a click on its middle, and the rim comes with the next [mm] [E]. */
const SMALLEST_MM = 0.3;

export class MeasureTool {
  private all: readonly Measure[] = [];
  private held: MeasureKind | undefined;
  /** Where the hand is that draws a circle. */
  private rim: { readonly mm: Vec3; readonly away: Vec3 } | undefined;
  /** The crosshair lays it, and shows where the next place would be. */
  private isByKeys = false;

  constructor(private readonly ct: Volume) {}

  get measures(): readonly Measure[] {
    return this.all;
  }

  /** What is in the hand. */
  get kind(): MeasureKind | undefined {
    return this.held;
  }

  /** @return all, the last as it would be with a place at the hand or, laid by keys, the crosshair */
  shown(cross: Vec3, away: Vec3): readonly Measure[] {
    const last = this.all.at(-1);
    if (last === undefined || isWhole(last)) return this.all;
    const next = this.rim ?? (this.isByKeys ? { mm: cross, away } : undefined);
    if (next === undefined) return this.all;
    return [...this.all.slice(0, -1), this.withPlace(last, next.mm, next.away)];
  }

  /** Takes it, or puts it down where it is held. @return what to say */
  toggle(kind: MeasureKind): string {
    this.held = this.held === kind ? undefined : kind;
    this.dropPart();
    if (this.held === undefined) return "";
    return `${HOW[kind]}, or Enter at the crosshair; Esc puts down.`;
  }

  /** By mouse or finger. @return what to say; undefined where it goes on */
  press(mm: Vec3, away: Vec3, phase: "down" | "move" | "up"): string | undefined {
    this.isByKeys = false;
    if (this.held !== "region") return phase === "down" ? this.add(mm, away) : undefined;
    const centre = this.pending?.places[0];
    if (phase === "down") {
      if (centre === undefined) this.add(mm, away);
      this.rim = { mm, away };
      return undefined;
    }
    if (centre === undefined || this.rim === undefined) return undefined;
    this.rim = { mm, away };
    if (phase === "move") return undefined;
    this.rim = undefined;
    return regionOf(centre, mm, away).radiusMm < SMALLEST_MM ? undefined : this.add(mm, away);
  }

  /** Enter at the crosshair. @return what to say; undefined where it goes on */
  addByKey(mm: Vec3, away: Vec3): string | undefined {
    const told = this.add(mm, away);
    this.isByKeys = true;
    return told;
  }

  /** @param away  across the slice in which it is laid */
  add(mm: Vec3, away: Vec3): string | undefined {
    const kind = this.held;
    if (kind === undefined) return undefined;
    const last = this.pending;
    const now = this.withPlace(last ?? { kind, places: [] }, mm, away);
    if (now.region !== undefined && now.region.radiusMm < SMALLEST_MM) {
      return "The circle has no size: its rim must lie off its middle.";
    }
    this.all = [...(last === undefined ? this.all : this.all.slice(0, -1)), now];
    if (!isWhole(now)) return undefined;
    if (now.region !== undefined) return regionText(now.region, now.region.values);
    return `${kind === "distance" ? "Distance" : "Angle"} ${measureText(now)}`;
  }

  dropLast(): void {
    this.all = this.all.slice(0, -1);
    this.rim = undefined;
  }

  putDown(): void {
    this.held = undefined;
    this.dropPart();
  }

  private get pending(): Measure | undefined {
    const last = this.all.at(-1);
    return last === undefined || isWhole(last) ? undefined : last;
  }

  private dropPart(): void {
    this.all = this.all.filter(isWhole);
    this.rim = undefined;
  }

  private withPlace({ kind, places }: Measure, mm: Vec3, away: Vec3): Measure {
    const [centre] = places;
    const all = [...places, mm];
    if (kind !== "region" || centre === undefined) return { kind, places: all };
    const region = regionOf(centre, mm, away);
    return { kind, places: all, region: { ...region, values: measureRegion(this.ct, region) } };
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Distance of two places and angle of three, in space: what is clicked in one picture and what in another
// belong together. The HU of a circle are of one slice.
import type { Vec3 } from "../protocol";
import { along, dot } from "./planes_model";
import { regionLines, type Region, type RegionValues } from "./region_model";

export type MeasureKind = "distance" | "angle" | "region";

export interface Measure {
  readonly kind: MeasureKind;
  /** Of a region its middle and a place on its rim. */
  readonly places: readonly Vec3[];
  readonly region?: Region & { readonly values: RegionValues };
}

export const placesNeeded = (kind: MeasureKind): number => (kind === "angle" ? 3 : 2);

export function isWhole({ kind, places }: Measure): boolean {
  return places.length === placesNeeded(kind);
}

/** "12.3 mm" or "47.1°", of a region two lines; empty while places are missing or lie on each other. */
export function measureText(measure: Measure): string {
  const { region } = measure;
  if (measure.kind === "region") {
    return region === undefined ? "" : regionLines(region, region.values).join("\n");
  }
  const [a, b, c] = measure.places;
  if (a === undefined || b === undefined) return "";
  const one = along(a, -1, b);
  if (measure.kind === "distance") return `${Math.sqrt(dot(one, one)).toFixed(1)} mm`;
  if (c === undefined) return "";
  const other = along(c, -1, b);
  const lengths = Math.sqrt(dot(one, one) * dot(other, other));
  if (!(lengths > 0)) return "";
  const cosine = Math.min(1, Math.max(-1, dot(one, other) / lengths));
  return `${((Math.acos(cosine) * 180) / Math.PI).toFixed(1)}°`;
}

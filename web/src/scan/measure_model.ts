// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Distance of two places and angle of three, in space: what is clicked in one picture and what in another
// belong together.
import type { Vec3 } from "../protocol";
import { along, dot } from "./planes_model";

export type MeasureKind = "distance" | "angle";

export interface Measure {
  readonly kind: MeasureKind;
  readonly places: readonly Vec3[];
}

export const placesNeeded = (kind: MeasureKind): number => (kind === "distance" ? 2 : 3);

export function isWhole({ kind, places }: Measure): boolean {
  return places.length === placesNeeded(kind);
}

/** "12.3 mm" or "47.1°"; empty while places are missing or lie on each other. */
export function measureText(measure: Measure): string {
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

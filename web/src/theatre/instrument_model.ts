// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Instruments are lists of round parts, at true size, as the host describes them. Frame Tool: the tip
// at the origin, +z towards the hand [mm].
import type { InstrumentPart } from "../protocol";

/** Radius and place along the axis [mm]. */
export type ProfilePoint = readonly [radius: number, z: number];

/** Parts that are drawn as one surface: of one material, on one axis, each where the last one ends. */
export interface Chain {
  readonly first: InstrumentPart;
  readonly profile: readonly ProfilePoint[];
}

function isSame(a: readonly number[], b: readonly number[]): boolean {
  return a.every((v, i) => v === b[i]);
}

function goesOn(chain: Chain, part: InstrumentPart): boolean {
  const { first } = chain;
  const [radius, z] = chain.profile.at(-1) ?? [NaN, NaN];
  return (
    !first.is_threaded &&
    !part.is_threaded &&
    z === part.from_mm &&
    radius === part.radius_mm &&
    part.material === first.material &&
    part.only_in_hand === first.only_in_hand &&
    isSame(part.axis, first.axis) &&
    isSame(part.origin_mm, first.origin_mm) &&
    isSame(part.squash, first.squash)
  );
}

/** The parts in order, those that go on from the last joined, so that no seam is seen between them. */
export function chains(parts: readonly InstrumentPart[]): Chain[] {
  const out: Chain[] = [];
  for (const part of parts) {
    const end: ProfilePoint = [part.end_radius_mm, part.to_mm];
    const last = out.at(-1);
    if (last !== undefined && goesOn(last, part)) {
      out[out.length - 1] = { first: last.first, profile: [...last.profile, end] };
    } else {
      out.push({ first: part, profile: [[part.radius_mm, part.from_mm], end] });
    }
  }
  return out;
}

/** What of the parts lies between two places along the shaft: a wire's piece up to its bend, or behind it. */
export function partsBetween(
  parts: readonly InstrumentPart[],
  fromMm: number,
  toMm: number,
): InstrumentPart[] {
  return parts.flatMap((part) => {
    const from_mm = Math.max(part.from_mm, fromMm);
    const to_mm = Math.min(part.to_mm, toMm);
    if (!(to_mm > from_mm)) return part.from_mm === part.to_mm && from_mm === to_mm ? [part] : [];
    const slope = (part.end_radius_mm - part.radius_mm) / (part.to_mm - part.from_mm);
    const radiusAt = (mm: number): number => part.radius_mm + slope * (mm - part.from_mm);
    return [
      { ...part, from_mm, to_mm, radius_mm: radiusAt(from_mm), end_radius_mm: radiusAt(to_mm) },
    ];
  });
}

/** Turns of a thread from its beginning to `t` (0 to 1), where the pitch runs evenly [mm]. */
export function threadTurns(
  t: number,
  lengthMm: number,
  pitchMm: number,
  pitchEndMm: number,
): number {
  const slope = (pitchEndMm - pitchMm) / lengthMm;
  const z = t * lengthMm;
  // The integral of one over the pitch.
  if (Math.abs(slope) < 1e-9) return z / pitchMm;
  return Math.log((pitchMm + slope * z) / pitchMm) / slope;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Instruments as lists of round parts, at true size, so that a host can send them. Frame Tool: the tip
// at the origin, +z towards the hand [mm].
import type { Vec3 } from "../protocol";

export type PartKind = "cylinder" | "cone" | "sphere" | "threaded";
export type PartMaterial = "steel" | "titanium" | "handle" | "black";

export interface InstrumentPart {
  readonly kind: PartKind;
  /** Where it begins and ends along its axis [mm]; a sphere is centred between. */
  readonly from_mm: number;
  readonly to_mm: number;
  /** At `from_mm`; of a threaded part the outer one. */
  readonly radius_mm: number;
  /** At `to_mm`; as at `from_mm` where it is not said. */
  readonly radius_end_mm?: number;
  readonly material: PartMaterial;
  /** Lead of the thread at either end [mm]; the first holds for both where the second is not said. */
  readonly pitch_mm?: number;
  readonly pitch_end_mm?: number;
  /** The part's own axis in Tool where it does not lie on z, as a pistol's grip. */
  readonly origin_mm?: Vec3;
  readonly axis?: Vec3;
  /** Scales across the axis: a grip is no cylinder. */
  readonly squash?: readonly [number, number];
}

/** Radius and place along the axis [mm]. */
export type ProfilePoint = readonly [radius: number, z: number];

/** Cones and cylinders end to end through the points of a profile. */
export function turned(profile: readonly ProfilePoint[], material: PartMaterial): InstrumentPart[] {
  return profile.slice(1).map(([radiusEnd, to], i) => {
    const [radius, from] = profile[i] ?? [0, 0];
    return {
      kind: radius === radiusEnd ? "cylinder" : "cone",
      from_mm: from,
      to_mm: to,
      radius_mm: radius,
      radius_end_mm: radiusEnd,
      material,
    };
  });
}

/** Parts that are drawn as one surface: of one material, on one axis, each where the last one ends. */
export interface Chain {
  readonly first: InstrumentPart;
  readonly profile: readonly ProfilePoint[];
}

function goesOn(chain: Chain, part: InstrumentPart): boolean {
  const { first } = chain;
  const [radius, z] = chain.profile.at(-1) ?? [NaN, NaN];
  return (
    isTurned(first) &&
    isTurned(part) &&
    z === part.from_mm &&
    radius === part.radius_mm &&
    part.material === first.material &&
    first.axis === undefined &&
    part.axis === undefined &&
    part.squash === undefined &&
    first.squash === undefined &&
    part.origin_mm === undefined &&
    first.origin_mm === undefined
  );
}

export function isTurned({ kind }: InstrumentPart): boolean {
  return kind === "cylinder" || kind === "cone";
}

/** The parts in order, those that go on from the last joined, so that no seam is seen between them. */
export function chains(parts: readonly InstrumentPart[]): Chain[] {
  const out: Chain[] = [];
  for (const part of parts) {
    const end: ProfilePoint = [part.radius_end_mm ?? part.radius_mm, part.to_mm];
    const last = out.at(-1);
    if (last !== undefined && goesOn(last, part)) {
      out[out.length - 1] = { first: last.first, profile: [...last.profile, end] };
    } else {
      out.push({ first: part, profile: [[part.radius_mm, part.from_mm], end] });
    }
  }
  return out;
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

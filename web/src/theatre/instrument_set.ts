// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What dorsal scaphoid fixation is done with: guide wire, powered driver, headless compression screw
// and its driver, as parts in frame Tool (instrument_model.ts).
import type { Screw } from "../protocol";
import { turned, type InstrumentPart, type ProfilePoint } from "./instrument_model";

export const WIRE_DIAMETER_MM = 1.14;
export const WIRE_LENGTH_MM = 150;
/** Of the trocar point. */
const POINT_MM = 2.4;
/** Where the driver grips the wire, from its tip. */
const CHUCK_MM = 72;
/** Pitch at the tip and at the tail [mm]: coarse leads, so that the screw draws the parts together. */
const TIP_PITCH_MM = 1.4;
const TAIL_PITCH_MM = 0.9;

export type ScrewShape = Pick<Screw, "length_mm" | "tip_diameter_mm" | "tail_diameter_mm">;

/** Double-pointed in truth; the point at the hand's end is hidden in the driver. */
export function wireParts(lengthMm = WIRE_LENGTH_MM): InstrumentPart[] {
  const r = WIRE_DIAMETER_MM / 2;
  return turned(
    [
      [0, 0],
      [r, POINT_MM],
      [r, lengthMm],
    ],
    "steel",
  );
}

/** Pistol-grip wire driver; the wire runs through it. */
export function wireDriverParts(): InstrumentPart[] {
  const from = (profile: readonly ProfilePoint[]): ProfilePoint[] =>
    profile.map(([r, z]) => [r, CHUCK_MM + z]);
  const grip = {
    material: "handle",
    origin_mm: [0, 0, CHUCK_MM + 66],
    axis: [0, -1, 0],
    squash: [0.82, 1.12],
    radius_mm: 11,
  } as const;
  return [
    ...turned(
      from([
        [0.9, 0],
        [2.2, 0.01],
        [3.4, 6],
        [7.2, 11],
        [7.6, 20],
        [7.6, 21],
      ]),
      "steel",
    ),
    ...turned(
      from([
        [7.6, 21],
        [9.6, 22.5],
        [13.4, 27],
        [14, 32],
        [14, 86],
        [12.8, 91],
        [7, 94],
      ]),
      "handle",
    ),
    ...turned(
      from([
        [14.15, 34],
        [14.3, 34.6],
        [14.3, 36],
        [14.15, 36.6],
      ]),
      "titanium",
    ),
    { kind: "sphere", from_mm: 2, to_mm: 24, ...grip },
    { kind: "cylinder", from_mm: 13, to_mm: 75, ...grip },
    { kind: "sphere", from_mm: 64, to_mm: 86, ...grip },
  ];
}

/** Cannulated hand driver; its blade is at the origin, in the screw's tail. */
export function screwDriverParts(): InstrumentPart[] {
  const profile: ProfilePoint[] = [[4.4, 60]];
  for (let i = 0; i <= 40; ++i) {
    const t = i / 40;
    const groove = i % 8 < 2 && i > 4 && i < 36 ? -1.1 : 0;
    profile.push([9.5 + 2.2 * Math.sin(Math.PI * t) + groove, 61 + 58 * t]);
  }
  profile.push([8, 122], [2.5, 124]);
  return [
    ...turned(
      [
        [1.5, -0.8],
        [1.5, 2],
        [2.1, 4],
        [2.1, 52],
        [4.4, 55],
        [4.4, 60],
      ],
      "steel",
    ),
    ...turned(profile, "handle"),
  ];
}

/** A tapered, fully threaded, headless screw with a running pitch. */
export function screwParts(shape: ScrewShape): InstrumentPart[] {
  return [
    {
      kind: "threaded",
      from_mm: 0,
      to_mm: shape.length_mm,
      radius_mm: shape.tip_diameter_mm / 2,
      radius_end_mm: shape.tail_diameter_mm / 2,
      pitch_mm: TIP_PITCH_MM,
      pitch_end_mm: TAIL_PITCH_MM,
      material: "titanium",
    },
  ];
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Wire and screw of a finished operation as parts to draw: the score says where they lie and how thick
// a screw is, no more.
import type { InstrumentPart, PlacedScrew } from "../protocol";

/** For the eye alone [mm]. */
const WIRE_RADIUS_MM = 0.57;
const POINT_MM = 2.4;
const PITCH_MM = 1.2;

const PLAIN = {
  is_threaded: false,
  pitch_mm: 0,
  end_pitch_mm: 0,
  only_in_hand: false,
  origin_mm: [0, 0, 0],
  axis: [0, 0, 1],
  squash: [1, 1],
} as const;

export function placedWireParts(lengthMm: number): InstrumentPart[] {
  const rod = { ...PLAIN, material: "steel", end_radius_mm: WIRE_RADIUS_MM } as const;
  return [
    { ...rod, from_mm: 0, to_mm: POINT_MM, radius_mm: 0 },
    { ...rod, from_mm: POINT_MM, to_mm: lengthMm, radius_mm: WIRE_RADIUS_MM },
  ];
}

export function placedScrewParts(screw: PlacedScrew, lengthMm: number): InstrumentPart[] {
  return [
    {
      ...PLAIN,
      material: "titanium",
      from_mm: 0,
      to_mm: lengthMm,
      radius_mm: screw.tip_diameter_mm / 2,
      end_radius_mm: screw.tail_diameter_mm / 2,
      is_threaded: true,
      pitch_mm: PITCH_MM,
      end_pitch_mm: PITCH_MM,
    },
  ];
}

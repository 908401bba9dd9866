// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The beam comes from where the views say, and is shown while the C-arm moves.
import { describe, expect, it } from "vitest";
import { BeamShown, roomAngles, towardsSource } from "./beam_model";

describe("towardsSource", () => {
  it.each([
    ["PA from dorsal", 0, 0, true, [0, 0, 1]],
    ["lateral from radial, a left hand's to the right", 90, 0, true, [1, 0, 0]],
    ["and a right hand's to the left", 90, 0, false, [-1, 0, 0]],
    ["a tilt towards proximal comes from below", 0, 90, true, [0, -1, 0]],
  ])("%s", (_, rotationDeg, tiltDeg, radialIsRight, expected) => {
    const source = towardsSource({ rotationDeg, tiltDeg }, radialIsRight);
    source.forEach((v, i) => {
      expect(v).toBeCloseTo(expected[i] ?? NaN, 12);
    });
  });

  it("stays in the room while the forearm turns under it", () => {
    const before = roomAngles({ rotation_deg: 45, tilt_deg: 10 }, 0);
    expect(roomAngles({ rotation_deg: 25, tilt_deg: 10 }, 20)).toEqual(before);
  });
});

describe("BeamShown", () => {
  const pa = { rotationDeg: 0, tiltDeg: 0 };
  const lateral = { rotationDeg: 90, tiltDeg: 0 };

  it("is drawn while the C-arm moves and goes by itself", () => {
    const beam = new BeamShown();
    expect(beam.update(pa, 0)).toBe(false);
    expect(beam.update(lateral, 100)).toBe(true);
    expect(beam.update(lateral, 2000)).toBe(true);
    expect(beam.update(lateral, 2700)).toBe(false);
  });

  it("follows slow turns too, and stays where it is wished", () => {
    const beam = new BeamShown();
    let shown = false;
    for (let i = 0; i < 20; ++i) shown = beam.update({ rotationDeg: 0.1 * i, tiltDeg: 0 }, i);
    expect(shown).toBe(true);
    beam.isWished = true;
    expect(beam.update(pa, 1e6)).toBe(true);
  });

  it("takes another exercise's stand for no move", () => {
    const beam = new BeamShown();
    beam.update(pa, 0);
    beam.forget();
    expect(beam.update(lateral, 10)).toBe(false);
  });
});

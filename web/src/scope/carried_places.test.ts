// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { BodyPose } from "../protocol";
import { CarriedPlaces } from "./carried_places";

const half = Math.SQRT1_2;
const REST: BodyPose = { quaternion: [1, 0, 0, 0], translation_mm: [0, 0, 0] };

describe("places that go with bones", () => {
  it("go with one as it turns and shifts", () => {
    const places = new CarriedPlaces([1, 0, 0, 0], [1, 0, 0, 0]);
    const into = new Float32Array(3);
    // A quarter turn about each axis in turn: about z x becomes y.
    const turned = (quaternion: BodyPose["quaternion"]): number[] => {
      places.lay(into, new Float32Array([1, 2, 3]), [
        REST,
        { quaternion, translation_mm: [10, 20, 30] },
      ]);
      return [...into].map((value) => Math.round(value * 1e4) / 1e4);
    };
    expect(turned([half, 0, 0, half])).toEqual([8, 21, 33]);
    expect(turned([half, half, 0, 0])).toEqual([11, 17, 32]);
    expect(turned([half, 0, half, 0])).toEqual([13, 22, 29]);
  });

  it("between several go as far with each as they are said to", () => {
    const places = new CarriedPlaces([0, 1, 2, 0, 2, 0, 0, 0], [0.5, 0.25, 0.25, 0, 1, 0, 0, 0]);
    const into = new Float32Array(6);
    places.lay(into, new Float32Array([1, 1, 1, 5, 5, 5]), [
      REST,
      { ...REST, translation_mm: [4, 0, 0] },
      { ...REST, translation_mm: [0, 8, 0] },
    ]);
    expect([...into]).toEqual([2, 3, 1, 5, 13, 5]);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import type { BodyPose } from "../protocol";
import {
  lesionUniforms,
  MOST_PAINTED,
  paintOf,
  scuffed,
  setLesions,
  type Lesion,
} from "./scope_lesions";

const BODIES = ["radius", "scaphoid", "lunate"];
/** The radius below, scaphoid and lunate a tenth of a millimetre above it. */
const sides = {
  rest: [-1, 0, 0, 1, 0, 0, -1, 0, 0.1, 1, 0, 0.1],
  proximal: [0, 0, 0, 0],
  distal: [1, 2, 1, 2],
  distalShare: [0, 0, 1, 1],
};
const WALLS = [
  { joint: "radiocarpal", sides },
  { joint: "midcarpal", sides },
];

const lesion = (look: Lesion["look"], joint: string, body = "radius"): Lesion => ({
  look,
  joint,
  body,
  from_mm: [0, -1, 0],
  to_mm: [0, 1, 0],
  radius_mm: 0.5,
});
const REST: BodyPose = { quaternion: [1, 0, 0, 0], translation_mm: [0, 0, 0] };

describe("what is wrong in a joint", () => {
  it("is painted in its own joint alone, and a loose body is no paint", () => {
    const uniforms = lesionUniforms();
    const lesions = [
      lesion("tear", "midcarpal"),
      lesion("bare", "radiocarpal"),
      lesion("loose", "radiocarpal"),
    ];
    setLesions(uniforms, paintOf(lesions, WALLS, BODIES), "radiocarpal", []);
    expect(uniforms.lesionCount.value).toBe(1);
    expect(uniforms.lesionTo.value[0]?.w).toBe(6);
    expect(uniforms.lesionFrom.value[0]?.w).toBe(0.5);
    setLesions(uniforms, [], "radiocarpal", []);
    expect(uniforms.lesionCount.value).toBe(0);
  });

  it("is painted on its own bone's side of a joint whose sides touch", () => {
    const uniforms = lesionUniforms();
    const both = [lesion("bare", "radiocarpal"), lesion("bare", "radiocarpal", "lunate")];
    setLesions(uniforms, paintOf(both, WALLS, BODIES), "radiocarpal", []);
    expect(uniforms.lesionOn.value.slice(0, 2).map(({ x }) => x)).toEqual([0, 1]);
  });

  it("gapes where it is torn between two bones, as far as these have parted", () => {
    const uniforms = lesionUniforms();
    const torn = [
      lesion("tear", "radiocarpal", "radius"),
      lesion("tear", "radiocarpal", "scaphoid"),
      lesion("stain", "radiocarpal", "scaphoid"),
    ];
    const painted = paintOf(torn, WALLS, BODIES);
    expect(painted.map(({ between }) => between)).toEqual([undefined, [1, 2], undefined]);
    const poses = [REST, REST, { ...REST, translation_mm: [3, 0, 0] as const }];
    setLesions(uniforms, painted, "radiocarpal", poses);
    expect(uniforms.lesionOn.value.slice(0, 3).map(({ y }) => y)).toEqual([-1, 0, -1]);
    const [scaphoid, lunate] = uniforms.gaping.value.map((bone) =>
      new THREE.Vector3(0, 0, 0.1).applyMatrix4(bone),
    );
    expect(lunate?.distanceTo(scaphoid ?? new THREE.Vector3())).toBeCloseTo(3, 6);
  });

  it("has cartilage hang in fronds where a punch bit it, on the side that it bit", () => {
    const uniforms = lesionUniforms();
    const scuffs = scuffed(
      [
        { joint: "midcarpal", at_mm: [7, 8, 9] },
        { joint: "radiocarpal", at_mm: [1, 0, 0.3] },
        { joint: "radiocarpal", at_mm: [1, 0, -0.2] },
      ],
      WALLS,
    );
    setLesions(uniforms, scuffs, "radiocarpal", []);
    expect(uniforms.lesionCount.value).toBe(2);
    expect(uniforms.lesionFrom.value[0]?.toArray().slice(0, 3)).toEqual([1, 0, 0.3]);
    expect(uniforms.lesionTo.value[0]?.w).toBe(5);
    expect(uniforms.lesionOn.value.slice(0, 2).map(({ x }) => x)).toEqual([1, 0]);
  });

  it("is painted as far as there is room", () => {
    const uniforms = lesionUniforms();
    const many = Array<Lesion>(MOST_PAINTED + 5).fill(lesion("soft", "radiocarpal"));
    setLesions(uniforms, paintOf(many, WALLS, BODIES), "radiocarpal", []);
    expect(uniforms.lesionCount.value).toBe(MOST_PAINTED);
  });
});

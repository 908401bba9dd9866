// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import type { ControlledScrew } from "../protocol";
import { reportOf } from "./findings_words_model";
import type { JointWall } from "./joint_wall";
import { holeUniforms, setHole, wayIn } from "./screw_hole";
import { screwGeometry } from "./screw_shape";

const SCREW: ControlledScrew = {
  body: "scaphoid",
  tail_mm: [0, 0, 0],
  tip_mm: [0, 0, 16],
  tail_radius_mm: 1.8,
  tip_radius_mm: 1.75,
  bore_radius_mm: 0.62,
  thread_depth_mm: 0.35,
  thread_pitch_mm: 1.1,
  length_mm: 16,
  line_mm: 21,
};

/** A flat wall across the screw's axis, before its trailing end where z is negative. */
function flatWall(z: number): JointWall {
  const geometry = new THREE.PlaneGeometry(20, 20).translate(0, 0, z);
  geometry.setAttribute("rest", geometry.getAttribute("position").clone());
  return {
    joint: "radiocarpal",
    geometry,
    triangles: 2,
    sides: { rest: [], proximal: [], distal: [], distalShare: [] },
    pose: () => undefined,
    setSheets: () => undefined,
    cutDisc: () => undefined,
    yieldSheet: () => false,
  };
}

describe("a screw in a joint", () => {
  it("is as long and thick as the host says, threaded, with a hollow end", () => {
    const shape = screwGeometry(SCREW);
    shape.computeBoundingBox();
    expect(shape.boundingBox?.min.z).toBeCloseTo(0, 5);
    expect(shape.boundingBox?.max.z).toBeCloseTo(16, 5);
    expect(shape.boundingBox?.max.x).toBeGreaterThan(1.7);
    expect(shape.boundingBox?.max.x).toBeLessThanOrEqual(1.8);
    const normal = shape.getAttribute("normal");
    const position = shape.getAttribute("position");
    for (let v = 0; v < position.count; ++v) {
      const radius = Math.hypot(position.getX(v), position.getY(v));
      // The trailing end's face looks back, out of the bone.
      if (position.getZ(v) === 0 && radius > 1 && Math.abs(normal.getZ(v)) > 0.99)
        expect(normal.getZ(v)).toBeLessThan(0);
    }
  });

  it("has a way down to it where it is buried, and none where it stands out", () => {
    const buried = wayIn(SCREW, [flatWall(-2)]);
    buried?.computeBoundingBox();
    expect(buried?.boundingBox?.min.z).toBeCloseTo(-2, 1);
    expect(wayIn(SCREW, [flatWall(1.5)])).toBeUndefined();
    expect(wayIn(SCREW, [])).toBeUndefined();
  });

  it("leaves the walls of other exercises whole", () => {
    const uniforms = holeUniforms();
    setHole(uniforms, SCREW);
    expect(uniforms.screwLong.value).toBe(16);
    setHole(uniforms, null);
    expect(uniforms.screwLong.value).toBe(0);
  });

  it("comes with what the operation's report says", () => {
    expect(reportOf(SCREW)).toContain("21 mm measured");
    expect(reportOf(null)).toBe("");
  });
});

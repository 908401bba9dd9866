// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Marks of an exercise in the scope's picture: small shining balls on the tissue, behind what stands before them.
import * as THREE from "three";
import type { BodyPose } from "../protocol";
import { sameBeads, type Bead } from "./scope_drill_model";
import { ballGeometry } from "./loose_bodies";
import { wetMaterial, type LensUniforms } from "./scope_shader";

const RADIUS_MM = { asked: 0.55, line: 0.22, passed: 0.22 } as const;
/** Colours that no tissue has. */
const COLOUR = { asked: 0x2fb8ff, line: 0x2fb8ff, passed: 0x7dff6a } as const;

export class ScopeBeads {
  readonly group = new THREE.Group();
  private beads: readonly Bead[] = [];
  private poses: readonly BodyPose[] = [];
  private bodies: readonly string[] = [];
  private readonly balls: Record<Bead["kind"], THREE.BufferGeometry>;
  private readonly materials: Record<Bead["kind"], THREE.Material>;

  constructor(lens: LensUniforms) {
    const kinds = ["asked", "line", "passed"] as const;
    const of = <T>(make: (kind: Bead["kind"]) => T): Record<Bead["kind"], T> =>
      Object.fromEntries(kinds.map((kind) => [kind, make(kind)])) as Record<Bead["kind"], T>;
    this.balls = of((kind) => ballGeometry(RADIUS_MM[kind], 2));
    this.materials = of((kind) => {
      const material = wetMaterial(lens, false);
      const shines = new THREE.Color(COLOUR[kind]);
      material.uniforms["shines"] = { value: new THREE.Vector4(...shines.toArray(), 1) };
      return material;
    });
  }

  /** @param bodies  names in the order of the poses */
  setBodies(bodies: readonly string[]): void {
    this.bodies = bodies;
  }

  set(beads: readonly Bead[]): void {
    if (sameBeads(beads, this.beads)) return;
    this.beads = beads;
    this.group.clear();
    for (const bead of beads) {
      const mesh = new THREE.Mesh(this.balls[bead.kind], this.materials[bead.kind]);
      mesh.frustumCulled = false; // the lens is no frustum
      this.group.add(mesh);
    }
    this.lay(this.poses);
  }

  /** Where they are now. */
  lay(poses: readonly BodyPose[]): void {
    this.poses = poses;
    this.beads.forEach((bead, i) => {
      const mesh = this.group.children[i];
      const pose = poses[this.bodies.indexOf(bead.body)];
      mesh?.position.set(...bead.atMm);
      if (mesh === undefined || pose === undefined) return;
      const [w, x, y, z] = pose.quaternion;
      mesh.position.applyQuaternion(new THREE.Quaternion(x, y, z, w));
      mesh.position.add(new THREE.Vector3(...pose.translation_mm));
    });
  }

  dispose(): void {
    for (const ball of Object.values(this.balls)) ball.dispose();
    for (const material of Object.values(this.materials)) material.dispose();
    this.group.clear();
  }
}

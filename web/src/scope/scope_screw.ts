// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A screw that lies in a bone, in the scope's picture, with the way down to it where it is buried.
import * as THREE from "three";
import type { BodyPose, ControlledScrew } from "../protocol";
import type { JointWall } from "./joint_wall";
import { wayIn } from "./screw_hole";
import { screwGeometry } from "./screw_shape";
import { wetMaterial, type LensUniforms } from "./scope_shader";

export class ScopeScrew {
  readonly group = new THREE.Group();
  private readonly metal: THREE.ShaderMaterial;
  private readonly lining: THREE.ShaderMaterial;
  private body = -1;

  constructor(lens: LensUniforms) {
    this.metal = wetMaterial(lens, true);
    this.lining = wetMaterial(lens, false);
    this.lining.side = THREE.DoubleSide;
  }

  set(screw: ControlledScrew | null, bodies: readonly string[], walls: readonly JointWall[]): void {
    this.clear();
    this.body = screw === null ? -1 : bodies.indexOf(screw.body);
    if (screw === null) return;
    const tail = new THREE.Vector3(...screw.tail_mm);
    const way = new THREE.Vector3(...screw.tip_mm).sub(tail).normalize();
    const lay = (geometry: THREE.BufferGeometry, material: THREE.Material): void => {
      const mesh = new THREE.Mesh(geometry, material);
      mesh.frustumCulled = false; // the lens is no frustum
      mesh.position.copy(tail);
      mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), way);
      this.group.add(mesh);
    };
    lay(screwGeometry(screw), this.metal);
    const hole = wayIn(screw, walls);
    if (hole !== undefined) lay(hole, this.lining);
  }

  /** Where its bone is now. */
  lay(poses: readonly BodyPose[]): void {
    const pose = poses[this.body];
    if (pose === undefined) return;
    const [w, x, y, z] = pose.quaternion;
    this.group.quaternion.set(x, y, z, w);
    this.group.position.set(...pose.translation_mm);
  }

  private clear(): void {
    for (const child of this.group.children) (child as THREE.Mesh).geometry.dispose();
    this.group.clear();
  }

  dispose(): void {
    this.clear();
    this.metal.dispose();
    this.lining.dispose();
  }
}

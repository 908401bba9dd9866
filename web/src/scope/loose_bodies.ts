// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Balls that float in the joints, where the host has them.
import * as THREE from "three";
import type { LooseBody } from "../protocol";
import type { Lesion } from "./scope_lesions";

export class LooseBodies {
  readonly group = new THREE.Group();
  /** By their place among the lesions. */
  private bodies: ReadonlyMap<number, { mesh: THREE.Mesh; joint: string }> = new Map();

  constructor(private readonly material: THREE.Material) {}

  set(lesions: readonly Lesion[]): void {
    this.dispose();
    const bodies = new Map<number, { mesh: THREE.Mesh; joint: string }>();
    lesions.forEach((lesion, place) => {
      if (lesion.look !== "loose") return;
      const mesh = new THREE.Mesh(ballGeometry(lesion.radius_mm), this.material);
      mesh.frustumCulled = false;
      mesh.visible = false;
      this.group.add(mesh);
      bodies.set(place, { mesh, joint: lesion.joint });
    });
    this.bodies = bodies;
  }

  /** Shown are those that are not out, where the scope is in their joint. */
  lay(joint: string, now: readonly LooseBody[]): void {
    for (const { mesh } of this.bodies.values()) mesh.visible = false;
    for (const { lesion, at_mm } of now) {
      const body = this.bodies.get(lesion);
      if (body === undefined) continue;
      body.mesh.visible = body.joint === joint;
      body.mesh.position.set(...at_mm);
    }
  }

  dispose(): void {
    for (const { mesh } of this.bodies.values()) mesh.geometry.dispose();
    this.group.clear();
    this.bodies = new Map();
  }
}

/** Inside out, as the joint's wall is, so that the same material shows its outside. */
export function ballGeometry(radiusMm: number, detail = 5): THREE.BufferGeometry {
  const geometry = new THREE.IcosahedronGeometry(radiusMm, detail);
  const position = geometry.getAttribute("position");
  const count = position.count;
  const normal = geometry.getAttribute("normal");
  for (let v = 0; v < count; ++v) {
    const [x, y, z] = [position.getX(v), position.getY(v), position.getZ(v)];
    const bump = 1 + 0.08 * Math.sin(3.1 * x + 1.7 * y) * Math.cos(2.3 * z);
    position.setXYZ(v, x * bump, y * bump * 0.85, z * bump);
    normal.setXYZ(v, -x / radiusMm, -y / radiusMm, -z / radiusMm);
  }
  // Every triangle the other way round.
  for (let v = 0; v + 2 < count; v += 3) {
    const second = new THREE.Vector3().fromBufferAttribute(position, v + 1);
    const third = new THREE.Vector3().fromBufferAttribute(position, v + 2);
    const n2 = new THREE.Vector3().fromBufferAttribute(normal, v + 1);
    const n3 = new THREE.Vector3().fromBufferAttribute(normal, v + 2);
    position.setXYZ(v + 1, third.x, third.y, third.z);
    position.setXYZ(v + 2, second.x, second.y, second.z);
    normal.setXYZ(v + 1, n3.x, n3.y, n3.z);
    normal.setXYZ(v + 2, n2.x, n2.y, n2.z);
  }
  const lining = new Float32Array(4 * count);
  for (let v = 0; v < count; ++v) lining[4 * v] = 1; // as cartilage is
  geometry.setAttribute("lining", new THREE.BufferAttribute(lining, 4));
  geometry.setAttribute("fibre", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  return geometry;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Balls that float in the joints, where the host has them.
import * as THREE from "three";
import type { LooseBody } from "../protocol";
import { insideOut, linedAs } from "./inside_out";
import type { Lesion } from "./scope_lesions";

const CARTILAGE = 0;

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
      const mesh = new THREE.Mesh(bodyGeometry(lesion.radius_mm), this.material);
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

/** Bumpy and a little flat, as they are. */
function bodyGeometry(radiusMm: number): THREE.BufferGeometry {
  const geometry = ballGeometry(radiusMm, 5);
  const position = geometry.getAttribute("position");
  for (let v = 0; v < position.count; ++v) {
    const [x, y, z] = [position.getX(v), position.getY(v), position.getZ(v)];
    const bump = 1 + 0.08 * Math.sin(3.1 * x + 1.7 * y) * Math.cos(2.3 * z);
    position.setXYZ(v, x * bump, y * bump * 0.85, z * bump);
  }
  return geometry;
}

/** Inside out, as the joint's wall is. */
export function ballGeometry(radiusMm: number, detail: number): THREE.BufferGeometry {
  return linedAs(insideOut(new THREE.IcosahedronGeometry(radiusMm, detail)), CARTILAGE);
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The C-arm's beam as light in the theatre: a cone from the source to the round field of the receptor,
// with its central ray.
import * as THREE from "three";
import type { Vec3 } from "../protocol";
import { FIELD_RADIUS_M, SOURCE_TO_TARGET_M, TARGET_TO_RECEPTOR_M } from "./beam_model";
import { ACCENT_COLOR } from "./materials";

const LENGTH_M = SOURCE_TO_TARGET_M + TARGET_TO_RECEPTOR_M;
const UP = new THREE.Vector3(0, 0, 1);

export class Beam {
  /** Its +z runs towards the source, its origin is what the beam is centred on [m]. */
  readonly group = new THREE.Group();
  private readonly towards = new THREE.Vector3();

  constructor() {
    const glow = (opacity: number): THREE.MeshBasicMaterial =>
      new THREE.MeshBasicMaterial({
        color: ACCENT_COLOR,
        transparent: true,
        opacity,
        depthWrite: false,
        side: THREE.DoubleSide,
        toneMapped: false,
      });
    const middle = (SOURCE_TO_TARGET_M - TARGET_TO_RECEPTOR_M) / 2;
    const cone = new THREE.ConeGeometry(FIELD_RADIUS_M, LENGTH_M, 64, 1, true)
      .rotateX(Math.PI / 2)
      .translate(0, 0, middle);
    const rim = new THREE.RingGeometry(0.98 * FIELD_RADIUS_M, FIELD_RADIUS_M, 96);
    const field = new THREE.CircleGeometry(FIELD_RADIUS_M, 96);
    for (const disc of [rim, field]) disc.translate(0, 0, -TARGET_TO_RECEPTOR_M);
    const ray = new THREE.CylinderGeometry(0.0004, 0.0004, LENGTH_M, 8)
      .rotateX(Math.PI / 2)
      .translate(0, 0, middle);
    for (const [geometry, opacity] of [
      [cone, 0.06],
      [field, 0.08],
      [rim, 0.8],
      [ray, 0.5],
    ] as const) {
      const part = new THREE.Mesh(geometry, glow(opacity));
      part.renderOrder = 8;
      this.group.add(part);
    }
    this.group.visible = false;
  }

  /** @param target  what it is centred on [m]; @param source  unit vector from there */
  show(target: THREE.Vector3, source: Vec3): void {
    this.group.visible = true;
    this.group.position.copy(target);
    this.group.quaternion.setFromUnitVectors(UP, this.towards.set(...source));
  }

  hide(): void {
    this.group.visible = false;
  }
}

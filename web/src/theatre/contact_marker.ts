// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the tip touches and how hard the bone pushes back.
import * as THREE from "three";
import { ACCENT_COLOR, ATTENTION_COLOR } from "./materials";

/** Length of the arrow per newton, and at most [mm]. */
const MM_PER_N = 1.2;
const LONGEST_MM = 36;

const Z = new THREE.Vector3(0, 0, 1);
const direction = new THREE.Vector3();

export class ContactMarker {
  readonly group = new THREE.Group();
  private readonly ring: THREE.Mesh<THREE.RingGeometry, THREE.MeshBasicMaterial>;
  private readonly arrow = new THREE.Group();
  private readonly stem: THREE.Mesh<THREE.CylinderGeometry, THREE.MeshBasicMaterial>;
  private readonly head: THREE.Mesh<THREE.ConeGeometry, THREE.MeshBasicMaterial>;

  constructor() {
    const flat = (color: string): THREE.MeshBasicMaterial =>
      new THREE.MeshBasicMaterial({
        color,
        transparent: true,
        opacity: 0.92,
        depthTest: false,
        side: THREE.DoubleSide,
        toneMapped: false,
      });
    this.ring = new THREE.Mesh(new THREE.RingGeometry(1.7, 2.1, 48), flat(ACCENT_COLOR));
    this.stem = new THREE.Mesh(
      new THREE.CylinderGeometry(0.28, 0.28, 1, 16).translate(0, 0.5, 0).rotateX(Math.PI / 2),
      flat(ATTENTION_COLOR),
    );
    this.head = new THREE.Mesh(
      new THREE.ConeGeometry(0.9, 2.2, 20).translate(0, 1.1, 0).rotateX(Math.PI / 2),
      flat(ATTENTION_COLOR),
    );
    this.arrow.add(this.stem, this.head);
    this.group.add(this.ring, this.arrow);
    this.group.renderOrder = 9;
    this.ring.renderOrder = this.stem.renderOrder = this.head.renderOrder = 9;
    this.group.visible = false;
  }

  show(
    at: readonly [number, number, number],
    normal: readonly [number, number, number],
    forceN: readonly [number, number, number],
  ): void {
    this.group.visible = true;
    this.group.position.set(at[0], at[1], at[2]);
    direction.set(normal[0], normal[1], normal[2]);
    this.ring.visible = direction.lengthSq() > 0;
    if (this.ring.visible) this.ring.quaternion.setFromUnitVectors(Z, direction.normalize());
    direction.set(forceN[0], forceN[1], forceN[2]);
    const size = direction.length();
    // Under a twentieth of a newton nothing is felt.
    this.arrow.visible = size > 0.05;
    if (!this.arrow.visible) return;
    const lengthMm = Math.min(LONGEST_MM, 1 + MM_PER_N * size);
    this.arrow.quaternion.setFromUnitVectors(Z, direction.normalize());
    this.stem.scale.set(1, 1, lengthMm);
    this.head.position.set(0, 0, lengthMm);
  }

  hide(): void {
    this.group.visible = false;
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The line and the screw that the procedure is after, seen through the bone, and going with it.
import * as THREE from "three";
import type { Ideal, Instrument } from "../protocol";
import { ACCENT_COLOR } from "./materials";

/** How far the line stands out, towards the hand [mm]. */
const OUTSIDE_MM = 45;
const LINE_RADIUS_MM = 0.3;
const SEGMENTS = 24;
const UP = new THREE.Vector3(0, 1, 0);

export class Ghost {
  /** In the frame of the ideal's body as scanned [mm]; to be put under it. */
  readonly group = new THREE.Group();

  constructor() {
    this.group.visible = false;
  }

  /** Draws another; nothing where there is none. */
  set(ideal: Ideal | null, instruments: readonly Instrument[]): void {
    this.clear();
    if (ideal === null) return;
    const entry = new THREE.Vector3(...ideal.entry_mm);
    const inward = new THREE.Vector3(...ideal.direction);
    this.add(entry, inward, -OUTSIDE_MM, ideal.length_mm, LINE_RADIUS_MM, LINE_RADIUS_MM, 0.9);
    const screw = instruments.find((one) => one.id === ideal.screw);
    if (screw === undefined) return;
    const tail = ideal.screw_tail_mm;
    const radii = [screw.tail_diameter_mm / 2, screw.tip_diameter_mm / 2] as const;
    this.add(entry, inward, tail, tail + screw.length_mm, ...radii, 0.35);
  }

  private add(
    entry: THREE.Vector3,
    inward: THREE.Vector3,
    fromMm: number,
    toMm: number,
    fromRadius: number,
    toRadius: number,
    opacity: number,
  ): void {
    const geometry = new THREE.CylinderGeometry(toRadius, fromRadius, toMm - fromMm, SEGMENTS);
    const material = new THREE.MeshBasicMaterial({
      color: ACCENT_COLOR,
      transparent: true,
      opacity,
      depthTest: false,
      depthWrite: false,
      toneMapped: false,
    });
    const part = new THREE.Mesh(geometry, material);
    part.position.copy(entry).addScaledVector(inward, (fromMm + toMm) / 2);
    part.quaternion.setFromUnitVectors(UP, inward);
    part.renderOrder = 9;
    this.group.add(part);
  }

  private clear(): void {
    for (const part of this.group.children) {
      if (!(part instanceof THREE.Mesh)) continue;
      const mesh = part as THREE.Mesh<THREE.BufferGeometry, THREE.Material>;
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.group.clear();
  }

  dispose(): void {
    this.clear();
    this.group.removeFromParent();
  }
}

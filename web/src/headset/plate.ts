// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A flat screen in the room, drawn on a canvas.
import * as THREE from "three";

export class Plate {
  readonly mesh: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshBasicMaterial>;
  readonly canvas = document.createElement("canvas");
  private readonly texture: THREE.CanvasTexture;

  /** @param widthM  its width in the room [m] @param pixels  of the canvas */
  constructor(widthM: number, pixels: readonly [width: number, height: number]) {
    [this.canvas.width, this.canvas.height] = pixels;
    this.texture = new THREE.CanvasTexture(this.canvas);
    this.texture.colorSpace = THREE.SRGBColorSpace;
    this.texture.anisotropy = 4;
    this.mesh = new THREE.Mesh(
      new THREE.PlaneGeometry(widthM, (widthM * pixels[1]) / pixels[0]),
      new THREE.MeshBasicMaterial({ map: this.texture, toneMapped: false }),
    );
  }

  /** The canvas was drawn on. */
  changed(): void {
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    this.texture.dispose();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}

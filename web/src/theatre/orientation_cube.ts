// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A small cube in a corner that says which way one looks at the hand.
import * as THREE from "three";
import type { FaceNames } from "../frames";

const SIZE_PX = 256;

function face(name: string): THREE.MeshBasicMaterial {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = SIZE_PX;
  const context = canvas.getContext("2d");
  if (context !== null) {
    context.fillStyle = "#1b2327";
    context.fillRect(0, 0, SIZE_PX, SIZE_PX);
    context.strokeStyle = "#3d4b52";
    context.lineWidth = 8;
    context.strokeRect(4, 4, SIZE_PX - 8, SIZE_PX - 8);
    context.fillStyle = "#dfe7ea";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.font = "600 56px 'Inter Variable', sans-serif";
    context.fillText(name, SIZE_PX / 2, SIZE_PX / 2 + 4);
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 4;
  return new THREE.MeshBasicMaterial({ map: texture, toneMapped: false });
}

export class OrientationCube {
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.OrthographicCamera(-0.95, 0.95, 0.95, -0.95, 0.1, 10);
  private readonly cube: THREE.Mesh<THREE.BoxGeometry, THREE.MeshBasicMaterial[]>;
  private readonly back = new THREE.Vector3();

  constructor(names: FaceNames) {
    // BoxGeometry's order: +x, -x, +y, -y, +z, -z.
    const order = [names.right, names.left, names.up, names.down, names.front, names.back];
    this.cube = new THREE.Mesh(new THREE.BoxGeometry(1, 1, 1), order.map(face));
    this.scene.add(this.cube);
  }

  /** Draws into the given square of the canvas [CSS px], over what is there. */
  draw(
    renderer: THREE.WebGLRenderer,
    viewer: THREE.Camera,
    x: number,
    y: number,
    side: number,
  ): void {
    viewer.matrixWorld.extractBasis(this.camera.up, this.camera.up, this.back);
    this.camera.quaternion.copy(viewer.quaternion);
    this.camera.position.copy(this.back).multiplyScalar(3);
    renderer.autoClear = false;
    renderer.clearDepth();
    renderer.setScissorTest(true);
    renderer.setViewport(x, y, side, side);
    renderer.setScissor(x, y, side, side);
    renderer.render(this.scene, this.camera);
    renderer.setScissorTest(false);
    renderer.autoClear = true;
  }

  dispose(): void {
    this.cube.geometry.dispose();
    for (const material of this.cube.material) {
      material.map?.dispose();
      material.dispose();
    }
  }
}

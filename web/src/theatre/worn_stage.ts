// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The theatre's scene as a headset draws it: life-size in the room of whoever wears it. What stands in that
// room hangs on `rig`, in metres of the room.
import * as THREE from "three";

/** What is nearer to the eyes is not drawn, nor what is farther [m]. */
const NEAR_M = 0.05;
const FAR_M = 20;
const DARK = new THREE.Color("#0b0f12");

export interface StageHandlers {
  /** A picture is about to be drawn. */
  before(): void;
  end(): void;
}

export class WornStage {
  /** The room. */
  readonly rig = new THREE.Group();
  private readonly camera = new THREE.PerspectiveCamera(70, 1, NEAR_M, FAR_M);
  private isOver = false;

  /** @param home  the middle of what is operated on, in the renderer's frame [m] */
  constructor(
    readonly renderer: THREE.WebGLRenderer,
    private readonly scene: THREE.Scene,
    readonly home: THREE.Vector3,
    private readonly handlers: StageHandlers,
  ) {
    this.rig.matrixAutoUpdate = false;
    this.rig.add(this.camera);
    scene.add(this.rig);
    scene.background = DARK;
  }

  /** Where the room is, seen from the scene. */
  setRoom(rendererFromRoom: THREE.Matrix4): void {
    this.rig.matrix.copy(rendererFromRoom);
    this.rig.updateMatrixWorld(true);
  }

  draw(): void {
    if (this.isOver) return;
    this.handlers.before();
    this.renderer.render(this.scene, this.camera);
  }

  end(): void {
    if (this.isOver) return;
    this.isOver = true;
    this.scene.remove(this.rig);
    this.scene.background = null;
    this.handlers.end();
  }
}

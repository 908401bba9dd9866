// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One large soft key light, a dim fill, and a room to be mirrored in steel.
import * as THREE from "three";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";

/** Half the width of what casts a shadow [m]. */
const SHADOW_HALF_M = 0.07;

export interface StudioLight {
  readonly rig: THREE.Group;
  /** Turns the lamp with the viewer, as one turns a theatre lamp. */
  follow(camera: THREE.Camera, target: THREE.Vector3): void;
  /** Side of the shadow map, 0 for no shadows. */
  setShadowPixels(side: number): void;
  dispose(): void;
}

export function studioLight(renderer: THREE.WebGLRenderer, scene: THREE.Scene): StudioLight {
  const generator = new THREE.PMREMGenerator(renderer);
  const room = new RoomEnvironment();
  const environment = generator.fromScene(room, 0.03);
  room.dispose();
  generator.dispose();
  scene.environment = environment.texture;
  scene.environmentIntensity = 0.55;

  const rig = new THREE.Group();
  const key = new THREE.DirectionalLight("#fff1dc", 2.15);
  key.castShadow = true;
  key.shadow.mapSize.set(2048, 2048);
  key.shadow.camera.left = key.shadow.camera.bottom = -SHADOW_HALF_M;
  key.shadow.camera.right = key.shadow.camera.top = SHADOW_HALF_M;
  key.shadow.camera.near = 0.1;
  key.shadow.camera.far = 0.9;
  key.shadow.radius = 5;
  key.shadow.bias = -0.0004;
  key.shadow.normalBias = 0.0003;
  const fill = new THREE.DirectionalLight("#8fb8d6", 0.3);
  const sky = new THREE.HemisphereLight("#cfdde6", "#1c1714", 0.28);
  rig.add(key, key.target, fill, fill.target, sky);
  scene.add(rig);

  const right = new THREE.Vector3();
  const up = new THREE.Vector3();
  const back = new THREE.Vector3();
  return {
    rig,
    follow(camera, target) {
      camera.matrixWorld.extractBasis(right, up, back);
      key.target.position.copy(target);
      key.position.copy(target).addScaledVector(right, -0.3);
      key.position.addScaledVector(up, 0.26).addScaledVector(back, 0.2);
      fill.target.position.copy(target);
      fill.position.copy(target).addScaledVector(right, 0.4);
      fill.position.addScaledVector(up, -0.15).addScaledVector(back, 0.25);
    },
    setShadowPixels(side) {
      key.castShadow = side > 0;
      if (side > 0) key.shadow.mapSize.set(side, side);
      key.shadow.map?.dispose();
      key.shadow.map = null;
    },
    dispose() {
      environment.dispose();
      key.dispose();
      fill.dispose();
      sky.dispose();
    },
  };
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One large soft key light, a dim fill, and a room to be mirrored in steel.
import * as THREE from "three";
import { defaultLook, MOST_LAMPS, type Lamp } from "../appearance";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";

/** Half the width of what casts a shadow [m]. */
const SHADOW_HALF_M = 0.07;
/** How far lamps stand from what is looked at [m]. */
const LAMP_M = 0.44;

export interface StudioLight {
  readonly rig: THREE.Group;
  /** 1 to 4 lamps; the first casts shadows. */
  setLamps(lamps: readonly Lamp[]): void;
  /** Turns the lamps with the viewer, as one turns a theatre lamp. */
  follow(camera: THREE.Camera, target: THREE.Vector3): void;
  /** Side of the shadow map, 0 for no shadows. */
  setShadowPixels(side: number): void;
  /** Makes anew what was drawn once and is mirrored since: a lost graphics context comes back without it. */
  mirrorAnew(): void;
  dispose(): void;
}

function mirroredRoom(renderer: THREE.WebGLRenderer): THREE.WebGLRenderTarget {
  const generator = new THREE.PMREMGenerator(renderer);
  const room = new RoomEnvironment();
  const mirrored = generator.fromScene(room, 0.03);
  room.dispose();
  generator.dispose();
  return mirrored;
}

export function studioLight(renderer: THREE.WebGLRenderer, scene: THREE.Scene): StudioLight {
  let environment = mirroredRoom(renderer);
  scene.environment = environment.texture;
  scene.environmentIntensity = 0.55;

  const rig = new THREE.Group();
  const lights: readonly [THREE.DirectionalLight, ...THREE.DirectionalLight[]] = [
    new THREE.DirectionalLight(),
    ...Array.from({ length: MOST_LAMPS - 1 }, () => new THREE.DirectionalLight()),
  ];
  const [key] = lights;
  key.castShadow = true;
  key.shadow.mapSize.set(2048, 2048);
  key.shadow.camera.left = key.shadow.camera.bottom = -SHADOW_HALF_M;
  key.shadow.camera.right = key.shadow.camera.top = SHADOW_HALF_M;
  key.shadow.camera.near = 0.1;
  key.shadow.camera.far = 0.9;
  key.shadow.radius = 5;
  key.shadow.bias = -0.0004;
  key.shadow.normalBias = 0.0003;
  const sky = new THREE.HemisphereLight("#cfdde6", "#1c1714", 0.28);
  for (const light of lights) rig.add(light, light.target);
  rig.add(sky);
  scene.add(rig);

  /** Of each lamp: to the right, up, back towards the viewer, unit. */
  const directions = lights.map(() => new THREE.Vector3(0, 0, 1));
  const setLamps = (lamps: readonly Lamp[]): void => {
    lights.forEach((light, index) => {
      const lamp = lamps[index];
      light.visible = lamp !== undefined && lamp.strength > 0;
      if (lamp === undefined) return;
      light.color.setRGB(...lamp.color, THREE.SRGBColorSpace);
      light.intensity = lamp.strength;
      const right = THREE.MathUtils.degToRad(lamp.right);
      const up = THREE.MathUtils.degToRad(lamp.up);
      directions[index]?.set(
        Math.sin(right) * Math.cos(up),
        Math.sin(up),
        Math.cos(right) * Math.cos(up),
      );
    });
  };
  setLamps(defaultLook().lamps);

  const right = new THREE.Vector3();
  const up = new THREE.Vector3();
  const back = new THREE.Vector3();
  return {
    rig,
    follow(camera, target) {
      camera.matrixWorld.extractBasis(right, up, back);
      lights.forEach((light, index) => {
        const towards = directions[index];
        if (towards === undefined) return;
        light.target.position.copy(target);
        light.position.copy(target).addScaledVector(right, LAMP_M * towards.x);
        light.position.addScaledVector(up, LAMP_M * towards.y);
        light.position.addScaledVector(back, LAMP_M * towards.z);
      });
    },
    setLamps,
    setShadowPixels(side) {
      key.castShadow = side > 0;
      if (side > 0) key.shadow.mapSize.set(side, side);
      key.shadow.map?.dispose();
      key.shadow.map = null;
    },
    mirrorAnew() {
      environment.dispose();
      environment = mirroredRoom(renderer);
      scene.environment = environment.texture;
    },
    dispose() {
      environment.dispose();
      for (const light of lights) light.dispose();
      sky.dispose();
    },
  };
}

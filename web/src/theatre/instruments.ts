// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Guide wire, powered driver, headless compression screw and its driver, at true size [mm]. Each
// lies along +z: its tip at the origin, the hand at +z.
import * as THREE from "three";
import { handleMaterial, metalMaterial } from "./materials";

export const WIRE_DIAMETER_MM = 1.14;
export const WIRE_LENGTH_MM = 150;
/** Of the trocar point. */
const POINT_MM = 2.4;
/** Where the driver grips the wire, from its tip. */
const CHUCK_MM = 72;

/** A profile (radius, z) turned about z; LatheGeometry turns about y, which goes to z here. */
function lathe(
  profile: readonly (readonly [number, number])[],
  segments = 48,
): THREE.BufferGeometry {
  const points = profile.map(([r, z]) => new THREE.Vector2(r, z));
  return new THREE.LatheGeometry(points, segments).rotateX(Math.PI / 2);
}

/** Double-pointed in truth; the point at the hand's end is hidden in the driver. */
export function wireGeometry(lengthMm = WIRE_LENGTH_MM): THREE.BufferGeometry {
  const r = WIRE_DIAMETER_MM / 2;
  return lathe(
    [
      [0, 0],
      [r, POINT_MM],
      [r, lengthMm],
      [r * 0.7, lengthMm],
      [0, lengthMm],
    ],
    24,
  );
}

/** Pistol-grip wire driver; the wire runs through it. */
export function wireDriver(): THREE.Group {
  const group = new THREE.Group();
  const steel = metalMaterial("#b9c2c7", 0.3);
  const dark = handleMaterial();
  const chuck = lathe([
    [0.9, CHUCK_MM],
    [2.2, CHUCK_MM],
    [3.4, CHUCK_MM + 6],
    [7.2, CHUCK_MM + 11],
    [7.6, CHUCK_MM + 20],
    [7.6, CHUCK_MM + 21],
  ]);
  const body = lathe([
    [7.6, CHUCK_MM + 21],
    [9.6, CHUCK_MM + 22.5],
    [13.4, CHUCK_MM + 27],
    [14, CHUCK_MM + 32],
    [14, CHUCK_MM + 86],
    [12.8, CHUCK_MM + 91],
    [7, CHUCK_MM + 94],
    [0, CHUCK_MM + 94],
  ]);
  const grip = new THREE.CapsuleGeometry(11, 62, 8, 24);
  grip.scale(0.82, 1, 1.12);
  grip.translate(0, -44, CHUCK_MM + 66);
  const ring = lathe([
    [14.15, CHUCK_MM + 34],
    [14.3, CHUCK_MM + 34.6],
    [14.3, CHUCK_MM + 36],
    [14.15, CHUCK_MM + 36.6],
  ]);
  group.add(new THREE.Mesh(chuck, steel), new THREE.Mesh(body, dark), new THREE.Mesh(grip, dark));
  group.add(new THREE.Mesh(ring, metalMaterial("#7f9aa8", 0.35)));
  return group;
}

/** Cannulated hand driver; its blade is at the origin, in the screw's tail. */
export function screwDriver(): THREE.Group {
  const group = new THREE.Group();
  const steel = metalMaterial("#b9c2c7", 0.28);
  const shaft = lathe([
    [0.7, -0.8],
    [1.5, -0.8],
    [1.5, 2],
    [2.1, 4],
    [2.1, 52],
    [4.4, 55],
    [4.4, 60],
  ]);
  const profile: (readonly [number, number])[] = [[4.4, 60]];
  for (let i = 0; i <= 40; ++i) {
    const t = i / 40;
    const groove = i % 8 < 2 && i > 4 && i < 36 ? -1.1 : 0;
    profile.push([9.5 + 2.2 * Math.sin(Math.PI * t) + groove, 61 + 58 * t]);
  }
  profile.push([8, 122], [2.5, 124], [0, 124]);
  group.add(new THREE.Mesh(shaft, steel), new THREE.Mesh(lathe(profile), handleMaterial()));
  return group;
}

export interface ScrewShape {
  readonly lengthMm: number;
  readonly tipDiameterMm: number;
  readonly tailDiameterMm: number;
}

/** Pitch at the tip and at the tail [mm]: coarse leads, so that the screw draws the parts together. */
const TIP_PITCH_MM = 1.4;
const TAIL_PITCH_MM = 0.9;
const THREAD_DEPTH_MM = 0.42;

/** A tapered, fully threaded, headless screw with a running pitch; its tip at the origin. */
export function screwGeometry(shape: ScrewShape): THREE.BufferGeometry {
  const around = 40;
  const along = Math.max(80, Math.round(shape.lengthMm * 14));
  const positions = new Float32Array(3 * (around + 1) * (along + 1));
  const length = shape.lengthMm;
  let at = 0;
  for (let i = 0; i <= along; ++i) {
    const z = (length * i) / along;
    const t = z / length;
    // Turns up to z: the integral of one over the pitch, which runs evenly from tip to tail.
    const slope = (TAIL_PITCH_MM - TIP_PITCH_MM) / length;
    const turns = Math.log((TIP_PITCH_MM + slope * z) / TIP_PITCH_MM) / slope;
    const outer = 0.5 * (shape.tipDiameterMm + (shape.tailDiameterMm - shape.tipDiameterMm) * t);
    const nose = Math.min(1, 0.55 + z / 2.2);
    for (let j = 0; j <= around; ++j) {
      const angle = (2 * Math.PI * j) / around;
      const phase = turns - j / around;
      const ridge = 1 - Math.abs(2 * (phase - Math.floor(phase)) - 1);
      const r = nose * (outer - THREAD_DEPTH_MM * (1 - Math.min(1, 1.7 * ridge)));
      positions[at++] = r * Math.cos(angle);
      positions[at++] = r * Math.sin(angle);
      positions[at++] = z;
    }
  }
  const index: number[] = [];
  for (let i = 0; i < along; ++i) {
    for (let j = 0; j < around; ++j) {
      const a = i * (around + 1) + j;
      const b = a + around + 1;
      index.push(a, a + 1, b, b, a + 1, b + 1);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}

const along = new THREE.Vector3();
const Z = new THREE.Vector3(0, 0, 1);

/** Lays an instrument with its tip at `tip` and its shaft along `shaft`; allocates nothing. */
export function alignShaft(
  object: THREE.Object3D,
  tip: readonly [number, number, number],
  shaft: readonly [number, number, number],
): void {
  object.position.set(tip[0], tip[1], tip[2]);
  along.set(shaft[0], shaft[1], shaft[2]);
  if (along.lengthSq() > 0) object.quaternion.setFromUnitVectors(Z, along.normalize());
}

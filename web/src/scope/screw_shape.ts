// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A headless screw as a scope shows it: its trailing end at the origin, its tip along +z. Threaded all along,
// cannulated, with a six-lobed socket in its trailing end.
import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import type { ControlledScrew } from "../protocol";

const AROUND = 36;
const A_PITCH = 5; // rings
/** Of the trailing end's radius over the thread's root: the socket, and how deep its lobes go. */
const SOCKET_SHARE = 0.6;
const LOBE_SHARE = 0.1;
const LOBES = 6;
const SOCKET_DEEP_MM = 1.5;
const BORE_SHOWN_MM = 3;

/** How far from the axis at an angle, and where along it. */
export type Ring = (angle: number) => readonly [radius: number, z: number];

/** Rings joined by facets that share their normals; an edge is where one band ends and the next begins. */
export function band(rings: readonly Ring[], around = AROUND): THREE.BufferGeometry {
  const places: number[] = [];
  const facets: number[] = [];
  rings.forEach((ring, r) => {
    for (let i = 0; i <= around; ++i) {
      const angle = (2 * Math.PI * i) / around;
      const [radius, z] = ring(angle);
      places.push(radius * Math.cos(angle), radius * Math.sin(angle), z);
      if (r === 0 || i === around) continue;
      const [a, b] = [(r - 1) * (around + 1) + i, r * (around + 1) + i];
      facets.push(a, a + 1, b, b, a + 1, b + 1);
    }
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setIndex(facets);
  geometry.computeVertexNormals();
  return geometry;
}

/** Over the thread's crests at 0, its roots at 1. */
function depthShare(z: number, angle: number, pitchMm: number): number {
  const turn = z / pitchMm - angle / (2 * Math.PI);
  const at = turn - Math.floor(turn);
  return Math.min(1, 3 * Math.abs(at - 0.5));
}

export function screwGeometry(screw: ControlledScrew): THREE.BufferGeometry {
  const { length_mm: long, tail_radius_mm: tail, tip_radius_mm: tip } = screw;
  const pitch = Math.max(0.3, screw.thread_pitch_mm);
  const thread =
    (z: number): Ring =>
    (angle) => [
      tail + ((tip - tail) * z) / long - screw.thread_depth_mm * depthShare(z, angle, pitch),
      z,
    ];
  const root = tail - screw.thread_depth_mm;
  const socket =
    (z: number): Ring =>
    (angle) => [root * (SOCKET_SHARE + LOBE_SHARE * Math.cos(LOBES * angle)), z];
  const bore =
    (z: number): Ring =>
    () => [screw.bore_radius_mm, z];
  const count = Math.ceil((long / pitch) * A_PITCH);
  const side = Array.from({ length: count + 1 }, (_, i) => thread((long * i) / count));
  const shape = mergeGeometries([
    band(side),
    band([socket(0), thread(0)]),
    band([socket(SOCKET_DEEP_MM), socket(0)]),
    band([bore(SOCKET_DEEP_MM), socket(SOCKET_DEEP_MM)]),
    band([bore(SOCKET_DEEP_MM + BORE_SHOWN_MM), bore(SOCKET_DEEP_MM)]),
    band([thread(long), bore(long)]),
    band([bore(long), bore(long - BORE_SHOWN_MM)]),
  ]);
  return lined(shape, () => [0, 0, 0, 0]);
}

/** With what the wet material asks for. @param weights  of what lines it, at z */
export function lined(
  geometry: THREE.BufferGeometry,
  weights: (vertex: number) => readonly [number, number, number, number],
): THREE.BufferGeometry {
  const { count } = geometry.getAttribute("position");
  const lining = Array.from({ length: count }, (_, v) => weights(v)).flat();
  const none = (): THREE.BufferAttribute =>
    new THREE.BufferAttribute(new Float32Array(3 * count), 3);
  geometry.setAttribute("lining", new THREE.Float32BufferAttribute(lining, 4));
  geometry.setAttribute("fibre", none());
  geometry.setAttribute("rest", none());
  return geometry;
}

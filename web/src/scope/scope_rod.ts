// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What works beside the scope, as the scope shows it: its tip at the origin, its shaft along +z, in many
// short rings for the wide lens.
import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

export type RodLook = "probe" | "open" | "closed";

const LENGTH_MM = 40;
const PROBE_MM = 0.5;
const FORCEPS_MM = 1;
const JAW_MM = 3.2;
const OPEN_RAD = 0.34;

const ringsFrom = (from: number): number[] => {
  const rings: number[] = [];
  for (let z = from; z <= LENGTH_MM; z *= 1.18) rings.push(z);
  return rings;
};

function turned(profile: readonly (readonly [number, number])[]): THREE.BufferGeometry {
  const points = profile.map(([radius, z]) => new THREE.Vector2(radius, z));
  const geometry = new THREE.LatheGeometry(points, 12);
  geometry.rotateX(Math.PI / 2);
  return geometry;
}

/** One of two spoons, about its hinge: the half of a cone, flat towards the other. */
function jaw(side: 1 | -1, openRad: number): THREE.BufferGeometry {
  const shape = turned([
    [0, 0],
    [0.45, 0.25],
    [0.8, 1],
    [0.95, 2],
    [1, JAW_MM],
  ]);
  const place = shape.getAttribute("position");
  for (let i = 0; i < place.count; ++i) place.setX(i, side * Math.max(0.06, side * place.getX(i)));
  shape.translate(0, 0, -JAW_MM);
  shape.rotateY(-side * openRad);
  shape.translate(0, 0, JAW_MM);
  shape.computeVertexNormals();
  return shape;
}

function finished(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const { count } = geometry.getAttribute("position");
  geometry.setAttribute("lining", new THREE.BufferAttribute(new Float32Array(4 * count), 4));
  geometry.setAttribute("fibre", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  geometry.setAttribute("rest", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  return geometry;
}

function forceps(openRad: number): THREE.BufferGeometry {
  const shaft = turned([
    [0, JAW_MM - 0.4],
    ...ringsFrom(JAW_MM).map((z) => [FORCEPS_MM, z] as const),
  ]);
  return finished(mergeGeometries([jaw(1, openRad), jaw(-1, openRad), shaft]));
}

export function rodGeometries(): Readonly<Record<RodLook, THREE.BufferGeometry>> {
  return {
    probe: finished(
      turned([[0, 0], [0.35, 0.15], ...ringsFrom(0.5).map((z) => [PROBE_MM, z] as const)]),
    ),
    open: forceps(OPEN_RAD),
    closed: forceps(0),
  };
}

/** Of what a hand holds. */
export function rodLook(hasJaws: boolean, isClosed: boolean): RodLook {
  if (!hasJaws) return "probe";
  return isClosed ? "closed" : "open";
}

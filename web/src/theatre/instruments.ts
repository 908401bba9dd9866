// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws an instrument from its parts (instrument_model.ts), at true size [mm], along +z.
import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { InstrumentPart, Material } from "../protocol";
import { chains, threadTurns, type Chain } from "./instrument_model";
import {
  blackMaterial,
  gloveMaterial,
  handleMaterial,
  steelMaterial,
  titaniumMaterial,
} from "./materials";

const AROUND = 48;
const THREAD_AROUND = 40;
/** Of a thread, per mm of its length. */
const THREAD_RINGS_PER_MM = 14;
const THREAD_DEPTH_MM = 0.42;

const MATERIALS: Readonly<Record<Material, () => THREE.MeshStandardMaterial>> = {
  steel: steelMaterial,
  titanium: titaniumMaterial,
  handle: handleMaterial,
  black: blackMaterial,
  glove: gloveMaterial,
};

/** One mesh for each surface; parts that go on from each other show no seam. */
export function drawInstrument(parts: readonly InstrumentPart[]): THREE.Group {
  const group = new THREE.Group();
  fillInstrument(group, parts);
  return group;
}

/** Draws other parts in the group from now on. */
export function fillInstrument(group: THREE.Group, parts: readonly InstrumentPart[]): void {
  clearInstrument(group);
  const materials = new Map<Material, THREE.MeshStandardMaterial>();
  for (const chain of chains(parts)) {
    const name = chain.first.material;
    const material = materials.get(name) ?? MATERIALS[name]();
    materials.set(name, material);
    const mesh = new THREE.Mesh(surface(chain), material);
    place(mesh, chain.first);
    group.add(mesh);
  }
}

export function clearInstrument(group: THREE.Group): void {
  for (const child of group.children) {
    const mesh = child as THREE.Mesh<THREE.BufferGeometry, THREE.Material>;
    mesh.geometry.dispose();
    mesh.material.dispose();
  }
  group.clear();
}

/** Whether the instrument's surfaces cast shadows. */
export function castShadows(group: THREE.Group): void {
  for (const child of group.children) child.castShadow = true;
}

function place(mesh: THREE.Mesh, part: InstrumentPart): void {
  mesh.quaternion.setFromUnitVectors(Z, along.set(...part.axis).normalize());
  mesh.position.set(...part.origin_mm);
  mesh.scale.set(part.squash[0], part.squash[1], 1);
}

function surface(chain: Chain): THREE.BufferGeometry {
  return chain.first.is_threaded ? threadedSurface(chain.first) : turnedSurface(chain);
}

/** A profile turned about z, its ends closed; LatheGeometry turns about y, which goes to z here. */
function turnedSurface({ profile }: Chain): THREE.BufferGeometry {
  const points = profile.map(([r, z]) => new THREE.Vector2(r, z));
  const surfaces: THREE.BufferGeometry[] = [
    new THREE.LatheGeometry(points, AROUND).rotateX(Math.PI / 2),
  ];
  const [start, end] = [profile[0], profile.at(-1)];
  if (start !== undefined && start[0] > 0)
    surfaces.push(
      new THREE.CircleGeometry(start[0], AROUND).rotateX(Math.PI).translate(0, 0, start[1]),
    );
  if (end !== undefined && end[0] > 0)
    surfaces.push(new THREE.CircleGeometry(end[0], AROUND).translate(0, 0, end[1]));
  return merged(surfaces);
}

function merged(surfaces: THREE.BufferGeometry[]): THREE.BufferGeometry {
  const one = mergeGeometries(surfaces);
  for (const surface of surfaces) surface.dispose();
  return one;
}

/** A tapered thread with a running pitch, its tip rounded, its ends open. */
function threadedSurface(part: InstrumentPart): THREE.BufferGeometry {
  const length = part.to_mm - part.from_mm;
  const rings = Math.max(80, Math.round(length * THREAD_RINGS_PER_MM));
  const end = part.end_radius_mm;
  const positions = new Float32Array(3 * (THREAD_AROUND + 1) * (rings + 1));
  let at = 0;
  for (let i = 0; i <= rings; ++i) {
    const t = i / rings;
    const turns = threadTurns(t, length, part.pitch_mm, part.end_pitch_mm);
    const outer = part.radius_mm + (end - part.radius_mm) * t;
    const nose = Math.min(1, 0.55 + (t * length) / 2.2);
    for (let j = 0; j <= THREAD_AROUND; ++j) {
      const angle = (2 * Math.PI * j) / THREAD_AROUND;
      const phase = turns - j / THREAD_AROUND;
      const ridge = 1 - Math.abs(2 * (phase - Math.floor(phase)) - 1);
      const r = nose * (outer - THREAD_DEPTH_MM * (1 - Math.min(1, 1.7 * ridge)));
      positions[at++] = r * Math.cos(angle);
      positions[at++] = r * Math.sin(angle);
      positions[at++] = part.from_mm + t * length;
    }
  }
  return gridSurface(positions, rings, THREAD_AROUND);
}

/** Triangles over `rings + 1` rings of `around + 1` points each. */
function gridSurface(positions: Float32Array, rings: number, around: number): THREE.BufferGeometry {
  const index: number[] = [];
  for (let i = 0; i < rings; ++i) {
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

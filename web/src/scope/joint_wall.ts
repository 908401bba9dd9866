// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The inside of the joint: one closed wall of the host's scene, moved with the bones that it lies on.
// Generated, not seen in the CT.
import * as THREE from "three";
import type { BodyPose, Vec3 } from "../protocol";

/** As soft_tissue::Lining counts: synovium, bone, cartilage, disc, ligament. */
const LININGS = 5;
const SMOOTHINGS = 2;

export interface JointWall {
  /** Its id. */
  readonly joint: string;
  readonly geometry: THREE.BufferGeometry;
  readonly triangles: number;
  /** As scanned, Patient [mm]. */
  readonly middle: THREE.Vector3;
  /** Lays it where the bones are now. @param poses  of the bodies, in the case's order */
  pose(poses: readonly BodyPose[]): void;
  /** Places of the disc as scanned that yield. */
  setDisc(placesMm: readonly Vec3[]): void;
  /** Which of these places a shaver has taken away, and which way is out of the joint there. */
  cutDisc(places: readonly { readonly place: number; readonly outwards: Vec3 }[]): void;
  /** By how much they are off, three micrometres each; empty: they rest. */
  yieldDisc(offUm: readonly number[]): void;
}

/** What lines the disc's side of the joint. */
const DISC = 3;
/** A vertex goes with so many places of the disc, by how near they are. */
const PLACES = 4;
/** ... and less, the farther its nearest is [mm]. */
const DISC_REACH_MM = 2.5;
/** So far under the disc the ulna's head lies [mm]. */
const UNDER_MM = 1.7;

/** @param surface  of the node, in Patient [mm]. undefined where it is no joint's wall. */
export function jointWallOf(joint: string, surface: THREE.BufferGeometry): JointWall | undefined {
  const lining = surface.getAttribute("_lining");
  const [proximal, distal, share] = ["_proximal", "_distal", "_distal_share"].map((name) =>
    surface.getAttribute(name),
  );
  if (
    lining === undefined ||
    proximal === undefined ||
    distal === undefined ||
    share === undefined
  ) {
    return undefined;
  }
  const geometry = surface.clone();
  const count = lining.count;
  const weights = liningWeights(lining, surface.getIndex(), count);
  geometry.setAttribute("lining", new THREE.BufferAttribute(weights, 4));
  const fibre = surface.getAttribute("_fibre");
  geometry.setAttribute(
    "fibre",
    fibre === undefined ? new THREE.BufferAttribute(new Float32Array(3 * count), 3) : fibre.clone(),
  );
  for (const name of ["_lining", "_proximal", "_distal", "_distal_share", "_fibre"])
    geometry.deleteAttribute(name);
  const rest = new Float32Array(surface.getAttribute("position").array);
  geometry.setAttribute("rest", new THREE.BufferAttribute(rest, 3));
  const position = new THREE.BufferAttribute(new Float32Array(rest), 3);
  position.setUsage(THREE.DynamicDrawUsage);
  geometry.setAttribute("position", position);
  const moved = [new THREE.Vector3(), new THREE.Vector3()] as const;
  const turn = new THREE.Quaternion();
  const at = (pose: BodyPose | undefined, v: number, into: THREE.Vector3): void => {
    into.fromArray(rest, 3 * v);
    if (pose === undefined) return;
    const [w, x, y, z] = pose.quaternion;
    into.applyQuaternion(turn.set(x, y, z, w));
    into.x += pose.translation_mm[0];
    into.y += pose.translation_mm[1];
    into.z += pose.translation_mm[2];
  };
  geometry.computeBoundingSphere();
  const isDisc = Array.from({ length: count }, (_, v) => Math.round(lining.getX(v)) === DISC);
  let bound: readonly Bound[] = [];
  let off: readonly number[] = [];
  let cut: ReadonlyMap<number, Vec3> = new Map();
  const gone = new THREE.BufferAttribute(new Float32Array(count), 1);
  geometry.setAttribute("gone", gone);
  const yielded = new THREE.Vector3();
  /** Turned as the forearm is. */
  const addYield = (poses: readonly BodyPose[]): void => {
    if (off.length === 0 && cut.size === 0) return;
    for (const { vertex, places, weights } of bound) {
      yielded.set(0, 0, 0);
      places.forEach((place, i) => {
        const outwards = cut.get(place);
        if (outwards !== undefined) {
          const deep = UNDER_MM * (weights[i] ?? 0);
          yielded.x += deep * outwards[0];
          yielded.y += deep * outwards[1];
          yielded.z += deep * outwards[2];
        }
        const w = (weights[i] ?? 0) / 1000;
        yielded.x += w * (off[3 * place] ?? 0);
        yielded.y += w * (off[3 * place + 1] ?? 0);
        yielded.z += w * (off[3 * place + 2] ?? 0);
      });
      const pose = poses[proximal.getX(vertex)];
      if (pose !== undefined) {
        const [w, x, y, z] = pose.quaternion;
        yielded.applyQuaternion(turn.set(x, y, z, w));
      }
      position.setXYZ(
        vertex,
        position.getX(vertex) + yielded.x,
        position.getY(vertex) + yielded.y,
        position.getZ(vertex) + yielded.z,
      );
    }
  };
  return {
    joint,
    geometry,
    middle: geometry.boundingSphere?.center.clone() ?? new THREE.Vector3(),
    triangles: (surface.getIndex()?.count ?? 0) / 3,
    pose: (poses) => {
      for (let v = 0; v < count; ++v) {
        at(poses[proximal.getX(v)], v, moved[0]);
        at(poses[distal.getX(v)], v, moved[1]);
        moved[0].lerp(moved[1], share.getX(v)).toArray(position.array, 3 * v);
      }
      addYield(poses);
      position.needsUpdate = true;
      geometry.computeVertexNormals();
      geometry.computeBoundingSphere();
    },
    setDisc: (placesMm) => {
      bound = placesMm.length === 0 ? [] : boundTo(rest, isDisc, placesMm);
      off = [];
      cut = new Map();
      gone.array.fill(0);
      gone.needsUpdate = true;
    },
    cutDisc: (places) => {
      if (places.length === cut.size) return;
      cut = new Map(places.map(({ place, outwards }) => [place, outwards]));
      gone.array.fill(0);
      for (const { vertex, places: near, weights } of bound) {
        let share = 0;
        near.forEach((place, i) => {
          if (cut.has(place)) share += weights[i] ?? 0;
        });
        gone.setX(vertex, share);
      }
      gone.needsUpdate = true;
    },
    yieldDisc: (offUm) => {
      off = offUm;
    },
  };
}

interface Bound {
  readonly vertex: number;
  readonly places: readonly number[];
  /** Of each, 1 in all, less far from the disc. */
  readonly weights: readonly number[];
}

/** The wall near the disc, each vertex with the places that it goes with. */
function boundTo(
  rest: Float32Array,
  isDisc: readonly boolean[],
  placesMm: readonly Vec3[],
): readonly Bound[] {
  const all: Bound[] = [];
  for (let vertex = 0; 3 * vertex < rest.length; ++vertex) {
    const [x, y, z] = [rest[3 * vertex] ?? 0, rest[3 * vertex + 1] ?? 0, rest[3 * vertex + 2] ?? 0];
    const near = placesMm
      .map((place, i) => ({ i, mm: Math.hypot(place[0] - x, place[1] - y, place[2] - z) }))
      .sort((a, b) => a.mm - b.mm)
      .slice(0, PLACES);
    const nearest = near[0]?.mm ?? Infinity;
    if (nearest > DISC_REACH_MM || (isDisc[vertex] !== true && nearest > 0.6 * DISC_REACH_MM))
      continue;
    const parts = near.map(({ mm }) => 1 / (mm * mm + 0.04));
    const sum = parts.reduce((a, b) => a + b, 0);
    const goes = isDisc[vertex] === true ? 1 : 0.5;
    all.push({
      vertex,
      places: near.map(({ i }) => i),
      weights: parts.map((part) => (goes * part) / sum),
    });
  }
  return all;
}

/** Cartilage, disc, ligament, bone; what is left is synovium. Smoothed, so that one runs into another. */
function liningWeights(
  lining: THREE.BufferAttribute | THREE.InterleavedBufferAttribute,
  index: THREE.BufferAttribute | null,
  count: number,
): Float32Array {
  const slot = [-1, 3, 0, 1, 2];
  let weights = new Float32Array(4 * count);
  for (let v = 0; v < count; ++v) {
    const at = slot[Math.min(LININGS - 1, Math.max(0, Math.round(lining.getX(v))))] ?? -1;
    if (at >= 0) weights[4 * v + at] = 1;
  }
  if (index === null) return weights;
  for (let pass = 0; pass < SMOOTHINGS; ++pass) {
    const sum = new Float32Array(weights);
    const of = new Float32Array(count).fill(1);
    for (let i = 0; i < index.count; i += 3) {
      for (let k = 0; k < 3; ++k) {
        const [a, b] = [index.getX(i + k), index.getX(i + ((k + 1) % 3))];
        of[a] = (of[a] ?? 0) + 1;
        for (let c = 0; c < 4; ++c)
          sum[4 * a + c] = (sum[4 * a + c] ?? 0) + (weights[4 * b + c] ?? 0);
      }
    }
    weights = sum.map((value, i) => value / (of[Math.floor(i / 4)] ?? 1));
  }
  return weights;
}

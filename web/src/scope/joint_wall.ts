// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The inside of the joint: one closed wall of the host's scene, moved with the bones that it lies on.
// Generated, not seen in the CT.
import * as THREE from "three";
import type { BodyPose, Vec3 } from "../protocol";
import { CarriedPlaces } from "./carried_places";
import { WallSheet, type SheetPlan } from "./wall_sheet";
import type { SidedWall } from "./wall_sides";

/** As soft_tissue::Lining counts: synovium, bone, cartilage, disc, ligament. */
const LININGS = 5;
const SMOOTHINGS = 2;

export interface JointWall {
  /** Its id. */
  readonly joint: string;
  readonly geometry: THREE.BufferGeometry;
  readonly triangles: number;
  /** As it was scanned. */
  readonly sides: SidedWall;
  /** Lays it where the bones are now. @param poses  of the bodies, in the case's order */
  pose(poses: readonly BodyPose[]): void;
  /** What of it yields. @param bodies  names, in the case's order */
  setSheets(plans: readonly SheetPlan[], bodies: readonly string[]): void;
  /** Which places of the disc a shaver has taken away, and which way is out of the joint there. */
  cutDisc(places: readonly { readonly place: number; readonly outwards: Vec3 }[]): void;
  /** As of the message `sheet`. @returns whether that sheet is part of this wall */
  yieldSheet(sheet: number, offUm: readonly number[]): boolean;
}

/** What lines the disc's side of the joint. */
const DISC = 3;
/** Of the plan's sheets the disc is the first. */
const DISC_SHEET = 0;

/** @param surface  of the node, in Patient [mm]. undefined where it is no joint's wall. */
export function jointWallOf(joint: string, surface: THREE.BufferGeometry): JointWall | undefined {
  const lining = surface.getAttribute("_lining");
  const [proximal, distal, share, withBodies, withShares] = [
    "_proximal",
    "_distal",
    "_distal_share",
    "_bodies",
    "_shares",
  ].map((name) => surface.getAttribute(name));
  if (
    lining === undefined ||
    proximal === undefined ||
    distal === undefined ||
    share === undefined ||
    withBodies === undefined ||
    withShares === undefined
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
  for (const name of Object.keys(geometry.attributes))
    if (name.startsWith("_")) geometry.deleteAttribute(name);
  const rest = new Float32Array(surface.getAttribute("position").array);
  geometry.setAttribute("rest", new THREE.BufferAttribute(rest, 3));
  geometry.setAttribute("share", share.clone());
  const values = (of: typeof share): number[] =>
    Array.from({ length: count }, (_, v) => of.getX(v));
  const sides: SidedWall = {
    rest,
    proximal: values(proximal),
    distal: values(distal),
    distalShare: values(share),
  };
  const position = new THREE.BufferAttribute(new Float32Array(rest), 3);
  position.setUsage(THREE.DynamicDrawUsage);
  geometry.setAttribute("position", position);
  const carried = new CarriedPlaces(withBodies.array, withShares.array);
  geometry.computeBoundingSphere();
  const isDisc = Array.from({ length: count }, (_, v) => Math.round(lining.getX(v)) === DISC);
  let sheets: readonly (WallSheet | undefined)[] = [];
  const gone = new THREE.BufferAttribute(new Float32Array(count), 1);
  geometry.setAttribute("gone", gone);
  const normals = (): Float32Array => {
    const scanned = new THREE.BufferGeometry();
    scanned.setAttribute("position", new THREE.BufferAttribute(rest, 3));
    scanned.setIndex(surface.getIndex());
    scanned.computeVertexNormals();
    return new Float32Array(scanned.getAttribute("normal").array);
  };
  return {
    joint,
    geometry,
    sides,
    triangles: (surface.getIndex()?.count ?? 0) / 3,
    pose: (poses) => {
      carried.lay(position.array as Float32Array, rest, poses);
      for (const sheet of sheets) sheet?.addTo(position.array as Float32Array, rest, poses);
      position.needsUpdate = true;
      geometry.computeVertexNormals();
      geometry.computeBoundingSphere();
    },
    setSheets: (plans, bodies) => {
      const wall = { ...sides, rest, normals: normals(), isDisc };
      sheets = plans.map((plan) =>
        plan.joint === joint ? new WallSheet(wall, plan, bodies.indexOf(plan.body)) : undefined,
      );
      gone.array.fill(0);
      gone.needsUpdate = true;
    },
    cutDisc: (places) => {
      const disc = sheets[DISC_SHEET];
      if (disc?.cutAway(places) !== true) return;
      gone.array.fill(0);
      disc.markGone(gone);
      gone.needsUpdate = true;
    },
    yieldSheet: (sheet, offUm) => {
      sheets[sheet]?.yield(offUm);
      return sheets[sheet] !== undefined;
    },
  };
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

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of a joint's wall that goes with a sheet that yields, the disc or a ligament: which of the wall's
// vertices lie on it, and by how much each is off.
import * as THREE from "three";
import type { BodyPose, ExerciseMessage, Vec3 } from "../protocol";
import { sideOf, type SidedWall } from "./wall_sides";

/** As the host tells it once. */
export type SheetPlan = NonNullable<ExerciseMessage["arthroscopy"]>["sheets"][number];

/** A wall as it was scanned. */
export interface ScannedWall extends Pick<SidedWall, "distal" | "distalShare"> {
  /** Three a vertex, Patient [mm]. */
  readonly rest: Float32Array;
  /** Out of the joint, three a vertex. */
  readonly normals: Float32Array;
  readonly isDisc: readonly boolean[];
}

interface Bound {
  readonly vertex: number;
  readonly places: readonly number[];
  /** Of each; in all how far it goes with the sheet, 1 on it and less beside it. */
  readonly weights: readonly number[];
  readonly goes: number;
}

/** A vertex goes with so many places, by how near they are: of a disc, which is cut away place by place, with the
 * nearest most of all; of a ligament evenly, since each place would show as a facet of its own. */
const DISC_PLACES = 4;
const LIGAMENT_PLACES = 10;
/** Of the disc the wall goes along so far from its nearest place [mm] ... */
const DISC_REACH_MM = 2.5;
/** ... and half as much where something else lines it, so near. */
const BESIDE_DISC_MM = 0.6 * DISC_REACH_MM;
/** Of a ligament it goes along whole up to here, and no more from there on [mm]. */
const LIGAMENT_WHOLE_MM = 1.2;
const LIGAMENT_REACH_MM = 2.8;
/** What lies so far before its places is the other side of the joint; half a millimetre under the wall is usual. */
const BEFORE_MM = 0.3;
const UNDER_WHOLE_MM = 0.1;
/** So far under a disc that was cut away the ulna's head lies [mm]. */
const UNDER_MM = 1.7;

export class WallSheet {
  private readonly bound: readonly Bound[];
  private offUm: readonly number[] = [];
  private cut: ReadonlyMap<number, Vec3> = new Map();
  private readonly turn = new THREE.Quaternion();
  private readonly moved = new THREE.Vector3();
  private readonly carried = new THREE.Vector3();

  /** @param body  of the sheet, in the case's order */
  constructor(
    wall: ScannedWall,
    private readonly plan: SheetPlan,
    private readonly body: number,
  ) {
    this.bound = boundTo(wall, plan, body);
  }

  /** As of the message `sheet`. */
  yield(offUm: readonly number[]): void {
    this.offUm = offUm;
  }

  /** Which of its places a shaver has taken away. @returns whether that is news */
  cutAway(places: readonly { readonly place: number; readonly outwards: Vec3 }[]): boolean {
    if (places.length === this.cut.size) return false;
    this.cut = new Map(places.map(({ place, outwards }) => [place, outwards]));
    return true;
  }

  /** How much of each vertex is gone, 0 to 1. */
  markGone(gone: THREE.BufferAttribute): void {
    for (const { vertex, places, weights } of this.bound) {
      let share = 0;
      places.forEach((place, i) => {
        if (this.cut.has(place)) share += weights[i] ?? 0;
      });
      if (share > 0) gone.setX(vertex, share);
    }
  }

  /** Moves vertices that lie where the bones have them to where the sheet has them.
   * @param position  three a vertex @param rest  as scanned */
  addTo(position: Float32Array, rest: Float32Array, poses: readonly BodyPose[]): void {
    const isLigament = this.plan.kind === "ligament";
    if (!isLigament && this.offUm.length === 0 && this.cut.size === 0) return;
    const pose = poses[this.body];
    if (pose === undefined) return;
    const [w, x, y, z] = pose.quaternion;
    this.turn.set(x, y, z, w);
    for (const { vertex, places, weights, goes } of this.bound) {
      const at = this.moved.set(0, 0, 0);
      places.forEach((place, i) => {
        const weight = weights[i] ?? 0;
        const um = weight / 1000;
        at.x += um * (this.offUm[3 * place] ?? 0);
        at.y += um * (this.offUm[3 * place + 1] ?? 0);
        at.z += um * (this.offUm[3 * place + 2] ?? 0);
        const outwards = this.cut.get(place);
        if (outwards === undefined) return;
        at.x += UNDER_MM * weight * outwards[0];
        at.y += UNDER_MM * weight * outwards[1];
        at.z += UNDER_MM * weight * outwards[2];
      });
      at.applyQuaternion(this.turn);
      const v = 3 * vertex;
      if (isLigament) {
        // Between two bones the host knows where it lies: what parts does not stretch it in pleats.
        const there = this.carried.fromArray(rest, v).applyQuaternion(this.turn);
        at.x += goes * (there.x + pose.translation_mm[0] - (position[v] ?? 0));
        at.y += goes * (there.y + pose.translation_mm[1] - (position[v + 1] ?? 0));
        at.z += goes * (there.z + pose.translation_mm[2] - (position[v + 2] ?? 0));
      }
      position[v] = (position[v] ?? 0) + at.x;
      position[v + 1] = (position[v + 1] ?? 0) + at.y;
      position[v + 2] = (position[v + 2] ?? 0) + at.z;
    }
  }
}

/** The wall near the sheet, each vertex with the places that it goes with. */
function boundTo(wall: ScannedWall, plan: SheetPlan, body: number): readonly Bound[] {
  const all: Bound[] = [];
  const isDistal = sideOf(wall, body) === 1;
  const { rest, normals } = wall;
  const reachMm = plan.kind === "disc" ? DISC_REACH_MM : LIGAMENT_REACH_MM;
  for (let vertex = 0; 3 * vertex < rest.length; ++vertex) {
    const [x, y, z] = [rest[3 * vertex] ?? 0, rest[3 * vertex + 1] ?? 0, rest[3 * vertex + 2] ?? 0];
    const isNear = plan.places_mm.some(
      (place) => (place[0] - x) ** 2 + (place[1] - y) ** 2 + (place[2] - z) ** 2 < reachMm ** 2,
    );
    if (!isNear) continue;
    const near = plan.places_mm
      .map((place, i) => ({ i, mm: Math.hypot(place[0] - x, place[1] - y, place[2] - z) }))
      .sort((a, b) => a.mm - b.mm);
    const [nearest] = near;
    if (nearest === undefined) continue;
    const { places, parts } = plan.kind === "disc" ? sharply(near) : evenly(near);
    const middle = [0, 0, 0];
    places.forEach((i, p) => {
      plan.places_mm[i]?.forEach((value, k) => {
        middle[k] = (middle[k] ?? 0) + (parts[p] ?? 0) * value;
      });
    });
    const [mx = 0, my = 0, mz = 0] = middle;
    const under =
      (mx - x) * (normals[3 * vertex] ?? 0) +
      (my - y) * (normals[3 * vertex + 1] ?? 0) +
      (mz - z) * (normals[3 * vertex + 2] ?? 0);
    const goes =
      plan.kind === "disc"
        ? goesWithDisc(nearest.mm, wall.isDisc[vertex] === true)
        : goesWithLigament(nearest.mm, under) *
          onSide(isDistal ? (wall.distalShare[vertex] ?? 0) : 1 - (wall.distalShare[vertex] ?? 0));
    if (goes === 0) continue;
    all.push({ vertex, places, weights: parts.map((part) => goes * part), goes });
  }
  return all;
}

interface Near {
  readonly i: number;
  readonly mm: number;
}

/** Parts of places, 1 in all. */
interface Parts {
  readonly places: readonly number[];
  readonly parts: readonly number[];
}

function sharply(near: readonly Near[]): Parts {
  return normalized(near.slice(0, DISC_PLACES), ({ mm }) => 1 / (mm * mm + 0.04));
}

/** Down to none for the next place, so that nothing jumps where another becomes the next. */
function evenly(near: readonly Near[]): Parts {
  const some = near.slice(0, LIGAMENT_PLACES);
  const nextMm = near[LIGAMENT_PLACES]?.mm ?? (some.at(-1)?.mm ?? 0) + 1;
  return normalized(some, ({ mm }) => (nextMm - mm) ** 2 + 1e-9);
}

function normalized(near: readonly Near[], partOf: (one: Near) => number): Parts {
  const all = near.map(partOf);
  const sum = all.reduce((a, b) => a + b, 0);
  return { places: near.map(({ i }) => i), parts: all.map((part) => part / sum) };
}

function goesWithDisc(mm: number, isDisc: boolean): number {
  if (mm > DISC_REACH_MM || (!isDisc && mm > BESIDE_DISC_MM)) return 0;
  return isDisc ? 1 : 0.5;
}

/** Smooth in both, so that what is bound and what is not do not part in a fold. */
function goesWithLigament(mm: number, underMm: number): number {
  const near = (LIGAMENT_REACH_MM - mm) / (LIGAMENT_REACH_MM - LIGAMENT_WHOLE_MM);
  const under = (underMm + BEFORE_MM) / (UNDER_WHOLE_MM + BEFORE_MM);
  return smooth(near) * smooth(under);
}

/** What lies on the other side of the joint may touch it as scanned, and does not go along. */
function onSide(share: number): number {
  return smooth((share - 0.25) / 0.5);
}

function smooth(share: number): number {
  const t = Math.min(1, Math.max(0, share));
  return t * t * (3 - 2 * t);
}

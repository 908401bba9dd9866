// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Rays over bones, by a tree of boxes over each bone's triangles (three-mesh-bvh,
// docs/decisions/0023-three-mesh-bvh.md). The tree is made once, in the bone's own frame: a bone
// that moves takes it along.
import * as THREE from "three";
import { acceleratedRaycast, MeshBVH } from "three-mesh-bvh";

/** A stretch of a line that lies within a bone, by distance from the line's start [mm]. */
export type Stretch = readonly [from: number, to: number];

/** Shorter than this it only grazes [mm]. */
const GRAZE_MM = 1e-4;

/** Makes the bone quick to hit. */
export function makeHittable(bone: THREE.Mesh): void {
  // Indirect: the order of the triangles stays as the host sent it.
  bone.geometry.boundsTree = new MeshBVH(bone.geometry, { indirect: true });
  bone.raycast = acceleratedRaycast;
}

export class BoneRays {
  private readonly hits: THREE.Intersection[] = [];
  private readonly bones: THREE.Mesh[];

  /** @param skin  hit instead of the bones where nothing is seen through it */
  constructor(
    bones: readonly THREE.Mesh[],
    private readonly skin?: () => THREE.Mesh,
  ) {
    this.bones = [...bones];
  }

  /** Whether rays end at the skin. */
  hitsSkin = false;

  /** The first point of any bone on the ray, in the scene's frame, into `out`. @return whether there is one */
  first(caster: THREE.Raycaster, out: THREE.Vector3): boolean {
    caster.firstHitOnly = true;
    this.hits.length = 0;
    const closed = this.hitsSkin ? this.skin?.() : undefined;
    caster.intersectObjects(closed === undefined ? this.bones : [closed], false, this.hits);
    const hit = this.hits[0];
    if (hit !== undefined) out.copy(hit.point);
    return hit !== undefined;
  }
}

const ray = new THREE.Ray();

/**
 * Where a line runs within a bone.
 * @param bone  closed, its triangles turned outwards
 * @param origin, direction  in the bone's own frame [mm]; the direction of length 1
 */
export function stretchesWithin(
  bone: THREE.BufferGeometry,
  origin: readonly [number, number, number],
  direction: readonly [number, number, number],
  lengthMm: number,
): Stretch[] {
  const tree = bone.boundsTree;
  if (!(tree instanceof MeshBVH)) return [];
  ray.origin.set(...origin);
  ray.direction.set(...direction);
  // Beyond the line's end too: the first crossing tells whether its start lies within.
  const hits = tree
    .raycast(ray, THREE.DoubleSide)
    .map((hit) => ({ at: hit.distance, leaves: (hit.face?.normal.dot(ray.direction) ?? 0) > 0 }))
    .sort((a, b) => a.at - b.at);
  const out: Stretch[] = [];
  let enteredAt = hits[0]?.leaves === true ? 0 : undefined;
  for (const { at, leaves } of hits) {
    if (!leaves) {
      enteredAt ??= at;
      continue;
    }
    if (enteredAt === undefined) continue;
    const end = Math.min(at, lengthMm);
    if (end - enteredAt > GRAZE_MM) out.push([enteredAt, end]);
    enteredAt = undefined;
  }
  return out;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was seen of a bone's cartilage, facet by facet, brought onto its drawn surface.
import type { CartilageOfBone, Vec3 } from "../protocol";

/** What a vertex of the bone is. */
export type Painted = "bone" | "seen" | "missed";

/** A vertex farther than this from all facets bears no cartilage [mm]. */
const REACH_MM = 1.2;

/** Facets by the cube of REACH_MM that they lie in. */
class Facets {
  private readonly cubes = new Map<string, number[]>();

  constructor(private readonly bone: CartilageOfBone) {
    bone.at_mm.forEach((at, index) => {
      const key = cubeOf(at).join();
      const cube = this.cubes.get(key);
      if (cube === undefined) this.cubes.set(key, [index]);
      else cube.push(index);
    });
  }

  paint(at: Vec3): Painted {
    const [x, y, z] = cubeOf(at);
    let least = REACH_MM;
    let painted: Painted = "bone";
    for (let i = x - 1; i <= x + 1; ++i)
      for (let j = y - 1; j <= y + 1; ++j)
        for (let k = z - 1; k <= z + 1; ++k)
          for (const index of this.cubes.get([i, j, k].join()) ?? []) {
            const facet = this.bone.at_mm[index];
            if (facet === undefined) continue;
            const mm = Math.hypot(facet[0] - at[0], facet[1] - at[1], facet[2] - at[2]);
            if (mm >= least) continue;
            least = mm;
            painted = this.bone.seen[index] === 1 ? "seen" : "missed";
          }
    return painted;
  }
}

function cubeOf(at: Vec3): [number, number, number] {
  return [Math.floor(at[0] / REACH_MM), Math.floor(at[1] / REACH_MM), Math.floor(at[2] / REACH_MM)];
}

/** @param positions  of the bone's vertices as scanned, three numbers each [mm] */
export function paintedVertices(
  bone: CartilageOfBone,
  positions: ArrayLike<number>,
): readonly Painted[] {
  const facets = new Facets(bone);
  return Array.from({ length: positions.length / 3 }, (_, v) =>
    facets.paint([positions[3 * v] ?? 0, positions[3 * v + 1] ?? 0, positions[3 * v + 2] ?? 0]),
  );
}

/** Row by row from the forearm: bones of the same row stay together when they are drawn apart. */
export function rowOf(bone: string): number {
  if (/^(radius|ulna)/.test(bone)) return 0;
  return /^(scaphoid|lunate|triquetrum|pisiform)/.test(bone) ? 1 : 2;
}

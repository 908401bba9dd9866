// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Ambient occlusion, computed once per vertex when a case is loaded, so that depth between the
// bones reads at no cost per frame.
//
// Method: 1. mark the voxels of a coarse grid that any surface passes through; 2. from each vertex
// march along fixed directions of its upper half space; 3. a ray that meets a marked voxel near by
// is dark, one that meets it far away is less so; 4. the mean, weighted by the cosine, is the light.

export interface Surface {
  /** x, y, z per vertex [mm]. */
  readonly positions: Float32Array;
  /** Unit normals, x, y, z per vertex. */
  readonly normals: Float32Array;
}

const VOXEL_MM = 0.8;
/** Beyond this nothing darkens [mm]: about the width of a carpal bone. */
const REACH_MM = 14;
/** A vertex does not darken itself: the ray starts this far out [mm]. */
const START_MM = 2.0;
/** Rays nearer to the surface than this graze the bone's own voxels (cosine to the normal). */
const MIN_COSINE = 0.45;
const DIRECTIONS = 24;
const MAX_VOXELS = 16_000_000;

/** Directions spread evenly over the sphere (Fibonacci lattice). */
function sphereDirections(count: number): Float32Array {
  const out = new Float32Array(3 * count);
  const golden = Math.PI * (3 - Math.sqrt(5));
  for (let i = 0; i < count; ++i) {
    const z = 1 - (2 * i + 1) / count;
    const r = Math.sqrt(1 - z * z);
    out.set([r * Math.cos(golden * i), r * Math.sin(golden * i), z], 3 * i);
  }
  return out;
}

class Occupancy {
  private readonly low = [Infinity, Infinity, Infinity];
  private readonly size = [0, 0, 0];
  private readonly cells: Uint8Array;

  constructor(surfaces: readonly Surface[]) {
    const high = [-Infinity, -Infinity, -Infinity];
    for (const { positions } of surfaces) {
      for (let i = 0; i < positions.length; ++i) {
        const v = positions[i] ?? 0;
        const axis = i % 3;
        if (v < (this.low[axis] ?? 0)) this.low[axis] = v;
        if (v > (high[axis] ?? 0)) high[axis] = v;
      }
    }
    let total = 1;
    for (let axis = 0; axis < 3; ++axis) {
      const cells = Math.max(
        1,
        Math.ceil(((high[axis] ?? 0) - (this.low[axis] ?? 0)) / VOXEL_MM) + 1,
      );
      this.size[axis] = cells;
      total *= cells;
    }
    this.cells = new Uint8Array(Number.isFinite(total) && total <= MAX_VOXELS ? total : 0);
    for (const { positions } of surfaces) {
      for (let i = 0; i + 2 < positions.length; i += 3) {
        const cell = this.cell(positions[i] ?? 0, positions[i + 1] ?? 0, positions[i + 2] ?? 0);
        if (cell >= 0) this.cells[cell] = 1;
      }
    }
  }

  private cell(x: number, y: number, z: number): number {
    const i = Math.floor((x - (this.low[0] ?? 0)) / VOXEL_MM);
    const j = Math.floor((y - (this.low[1] ?? 0)) / VOXEL_MM);
    const k = Math.floor((z - (this.low[2] ?? 0)) / VOXEL_MM);
    const [nx = 0, ny = 0, nz = 0] = this.size;
    if (i < 0 || j < 0 || k < 0 || i >= nx || j >= ny || k >= nz) return -1;
    return (k * ny + j) * nx + i;
  }

  has(x: number, y: number, z: number): boolean {
    const cell = this.cell(x, y, z);
    return cell >= 0 && this.cells[cell] === 1;
  }
}

/** Light that reaches each vertex, 0 to 1, one array per surface. All share one frame [mm]. */
export function vertexOcclusion(surfaces: readonly Surface[]): Float32Array[] {
  const occupancy = new Occupancy(surfaces);
  const directions = sphereDirections(2 * DIRECTIONS);
  return surfaces.map((surface) => occlusionOf(surface, occupancy, directions));
}

function occlusionOf(s: Surface, occupancy: Occupancy, directions: Float32Array): Float32Array {
  const light = new Float32Array(s.positions.length / 3);
  for (let v = 0; v < light.length; ++v) {
    const at = 3 * v;
    const [px, py, pz] = [s.positions[at] ?? 0, s.positions[at + 1] ?? 0, s.positions[at + 2] ?? 0];
    const [nx, ny, nz] = [s.normals[at] ?? 0, s.normals[at + 1] ?? 0, s.normals[at + 2] ?? 0];
    let open = 0;
    let weight = 0;
    for (let d = 0; d < directions.length; d += 3) {
      const dx = directions[d] ?? 0;
      const dy = directions[d + 1] ?? 0;
      const dz = directions[d + 2] ?? 0;
      const cosine = dx * nx + dy * ny + dz * nz;
      if (cosine < MIN_COSINE) continue;
      weight += cosine;
      let reached = REACH_MM;
      for (let t = START_MM; t < REACH_MM; t += VOXEL_MM) {
        if (occupancy.has(px + t * dx, py + t * dy, pz + t * dz)) {
          reached = t;
          break;
        }
      }
      open += cosine * (reached / REACH_MM);
    }
    light[v] = weight > 0 ? open / weight : 1;
  }
  return light;
}

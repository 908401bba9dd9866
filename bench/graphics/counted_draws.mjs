// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the recorded draws of one picture of the scope come to: calls, triangles, bytes of textures, and how long some
// integrated processors would take for them. Pure.

/** Pixels are shaded in squares of four: at edges of triangles some of them for nothing. An estimate. */
export const SQUARES = 1.5;
/** What a frame at 60 a second has, in ms, and how much of it one picture may take: the panorama, the page and the system want theirs. */
const FRAME_MS = 1000 / 60;
export const BUDGET = { calls: 20, triangles: 60_000, texture_bytes: 16 * 2 ** 20, cycles_per_64_pixels: 30_000, ms: FRAME_MS / 2 };

/** As their makers say: lanes that compute at once, highest clock. `compiled`: for this kind; else by lanes and clock alone. */
const PROCESSORS = [
  { name: "AMD Radeon of a Ryzen 5 4500U", lanes: 6 * 64, mhz: 1500, compiled: true },
  { name: "AMD Radeon of a Ryzen 3 3200U", lanes: 3 * 64, mhz: 1200, compiled: true },
  { name: "Intel Iris Xe of a Core i5-1135G7", lanes: 80 * 8, mhz: 1300, compiled: false },
  { name: "Intel UHD 620 of a Core i5-8250U", lanes: 24 * 8, mhz: 1100, compiled: false },
];

/** A SIMD unit has 16 lanes, and is busy for `cycles` with `lanes` invocations. */
const laneCycles = ({ cycles, lanes }) => (cycles * 16) / lanes;

function rowsOf(draws, scale, { lesions, cost, withAll }) {
  return draws.map((draw) => {
    // What covers the picture with one triangle does so in each size.
    const pixels = draw.pixels === null ? Math.PI * 0.25 * (draw.widePx * scale) ** 2 * (4 / Math.PI) : draw.pixels;
    const { stages } = cost(withAll(draw.vertex, lesions), withAll(draw.fragment, lesions));
    const [vertex, fragment] = stages;
    const shaded = pixels * (draw.pixels === null ? 1 : SQUARES);
    return {
      name: draw.name,
      vertices: draw.vertices,
      pixels: Math.round(pixels),
      cycles_per_64_pixels: fragment.cycles,
      registers: fragment.registers,
      lane_cycles: draw.vertices * laneCycles(vertex) + shaded * laneCycles(fragment),
    };
  });
}

function textureBytes(sidePx, draws) {
  // Render targets of the focus: the picture with its depths, halves of it twice, tiles.
  const inner = draws.filter((one) => one.pixels === null).slice(0, -1);
  const half = inner.reduce((sum, one) => sum + (one.widePx / draws[0].widePx) ** 2, 0);
  return Math.round(sidePx * sidePx * (8 + 8 * half));
}

/**
 * @param draws as recorded_draws.mjs has them
 * @param cost of a vertex and a fragment shader, as shader_cost.mjs has Mesa's compiler say; `withAll` gives a shader its lesions
 */
export function pictureOf(draws, { sidePx, lesions, cost, withAll }) {
  const rows = rowsOf(draws, sidePx / draws[0].widePx, { lesions, cost, withAll });
  const lane_cycles = rows.reduce((sum, one) => sum + one.lane_cycles, 0);
  return {
    picture_px: sidePx,
    calls: rows.length,
    triangles: Math.round(rows.reduce((sum, one) => sum + one.vertices / 3, 0)),
    texture_bytes: textureBytes(sidePx, draws),
    draws: rows,
    processors: PROCESSORS.map((one) => ({ ...one, ms: lane_cycles / (one.lanes * one.mhz * 1e3) })),
  };
}

/** What of it is more than a picture may take, by name. */
export function beyond({ calls, triangles, texture_bytes, draws, processors }) {
  const told = {
    calls,
    triangles,
    texture_bytes,
    cycles_per_64_pixels: Math.max(...draws.map((one) => one.cycles_per_64_pixels)),
    ms: Math.max(...processors.map((one) => one.ms)),
  };
  return Object.keys(BUDGET).filter((key) => told[key] > BUDGET[key]);
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture of four recorded draws, whose shaders cost what is said here: `node --test bench/graphics/counted_draws_test.mjs`.
import assert from "node:assert/strict";
import { test } from "node:test";

import { BUDGET, SQUARES, beyond, pictureOf } from "./counted_draws.mjs";

/** Two of the scene, 400 px across, one that halves it, and the last, onto the canvas. */
const DRAWS = [
  { name: "bone", vertices: 3000, widePx: 400, pixels: 10_000, vertex: "v", fragment: "bone" },
  { name: "probe", vertices: 600, widePx: 400, pixels: 500, vertex: "v", fragment: "probe" },
  { name: "halve", vertices: 3, widePx: 200, pixels: null, vertex: "v", fragment: "halve" },
  { name: "picture", vertices: 3, widePx: 400, pixels: null, vertex: "v", fragment: "picture" },
];
const CYCLES = { bone: 800, probe: 400, halve: 64, picture: 128 };
const asked = [];
const cost = (vertex, fragment) => {
  asked.push([vertex, fragment]);
  const of = (cycles) => ({ cycles, lanes: 64, registers: 32 });
  return { stages: [of(100), of(CYCLES[fragment.split("+")[0]])] };
};
const withAll = (shader, lesions) => `${shader}+${lesions}`;
const picture = (sidePx = 400) => pictureOf(DRAWS, { sidePx, lesions: 12, cost, withAll });
const near = (value, wanted) => assert.ok(Math.abs(value - wanted) < 1e-9 * wanted, `${value}, not ${wanted}`);

test("calls and triangles are those that were recorded", () => {
  const { calls, triangles, draws } = picture();
  assert.equal(calls, 4);
  assert.equal(triangles, 1202);
  assert.deepEqual(draws.map((one) => one.name), ["bone", "probe", "halve", "picture"]);
});

test("a draw's time is its vertices and its pixels, those of triangles with what their edges waste", () => {
  const [bone, , halve] = picture().draws;
  near(bone.lane_cycles, (3000 * 100 + 10_000 * SQUARES * 800) / 4);
  near(halve.lane_cycles, (3 * 100 + 200 * 200 * 64) / 4);
});

test("what covers a picture with one triangle grows with it, what was counted does not", () => {
  const [small, large] = [picture(400), picture(800)];
  assert.equal(small.draws[2].pixels, 200 * 200);
  assert.equal(large.draws[2].pixels, 400 * 400);
  assert.equal(large.draws[0].pixels, small.draws[0].pixels);
});

test("textures are the picture with its depths and what is drawn into on the way, not the canvas", () => {
  assert.equal(picture().texture_bytes, 400 * 400 * (8 + 8 * 0.25));
});

test("shaders are compiled with all the lesions that the scene has", () => {
  asked.length = 0;
  picture();
  assert.deepEqual(asked[0], ["v+12", "bone+12"]);
});

test("a processor with half the lanes takes twice as long", () => {
  const { draws, processors } = picture();
  const all = draws.reduce((sum, one) => sum + one.lane_cycles, 0);
  for (const one of processors) near(one.ms, all / (one.lanes * one.mhz * 1e3));
});

test("what is beyond its budget is told by name, what is just within is not", () => {
  const told = picture();
  assert.deepEqual(beyond(told), []);
  assert.deepEqual(beyond({ ...told, calls: BUDGET.calls }), []);
  assert.deepEqual(beyond({ ...told, calls: BUDGET.calls + 1 }), ["calls"]);
  const slow = [...told.processors, { ms: BUDGET.ms + 0.1 }];
  const dear = [{ ...told.draws[0], cycles_per_64_pixels: BUDGET.cycles_per_64_pixels + 1 }, ...told.draws];
  assert.deepEqual(beyond({ ...told, draws: dear, processors: slow }), ["cycles_per_64_pixels", "ms"]);
});

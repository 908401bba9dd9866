// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a case folder holds, for whoever has to hit, or to miss, something in it. Patient frame as scanned, mm.
import { readFileSync } from "node:fs";
import { join } from "node:path";

/** The vertices of a bone's surface, by its file's name ("capitate"). */
export function readVertices(caseFolder, bone) {
  const bytes = readFileSync(join(caseFolder, "bones", `${bone}.ply`));
  const end = "end_header\n";
  const begin = bytes.indexOf(end) + end.length;
  const head = bytes.subarray(0, begin).toString("latin1");
  if (!head.includes("format binary_little_endian"))
    throw new Error(`${bone}.ply is of another format`);
  const count = Number(/element vertex (\d+)/.exec(head)[1]);
  const [vertex] = head.split("element face");
  const sizes = [...vertex.matchAll(/property (\w+) \w+/g)].map(([, type]) => ({ double: 8, float: 4 })[type]);
  const stride = sizes.reduce((sum, size) => sum + size, 0);
  const [size] = sizes;
  if (!(stride > 0)) throw new Error(`${bone}.ply has vertices of another kind`);
  const number = (at) => (size === 8 ? bytes.readDoubleLE(at) : bytes.readFloatLE(at));
  return Array.from({ length: count }, (_, i) =>
    [0, 1, 2].map((axis) => number(begin + i * stride + axis * size)),
  );
}

/** The courses of the case's tendons, arteries and nerves of one kind. */
export function readStructures(caseFolder, kind) {
  const data = JSON.parse(readFileSync(join(caseFolder, "structures.json"), "utf8"));
  return data.structures.filter((one) => one.kind === kind);
}

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** @return {from, to, mm}: the nearest two of them */
export function nearestPair(all, others) {
  let best = { mm: Infinity };
  for (const from of all)
    for (const to of others) {
      const mm = distance(from, to);
      if (mm < best.mm) best = { from, to, mm };
    }
  return best;
}

/** The one that lies farthest along a direction. */
export function farthest(points, along) {
  const height = (p) => p.reduce((sum, v, i) => sum + v * along[i], 0);
  return points.reduce((a, b) => (height(b) > height(a) ? b : a));
}

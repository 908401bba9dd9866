// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What works beside the scope, as the scope shows it: its tip at the origin, its shaft along +z, in many
// short rings for the wide lens.
import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import type { InstrumentPart } from "../protocol";
import type { ToolKind } from "./scope_tools";

export type RodLook =
  "probe" | "open" | "closed" | "punch_open" | "punch_closed" | "shaver" | "blade";

const LENGTH_MM = 40;
const PROBE_MM = 0.5;
const FORCEPS_MM = 1;
const JAW_MM = 3.2;
const OPEN_RAD = 0.34;
/** Of a punch one jaw stays; the other opens wider. */
const PUNCH_OPEN_RAD = 0.62;
const SHAVER_MM = 1;
/** Its window: from, to, and how far from the axis it is cut [mm]. */
const WINDOW_MM = [0.25, 2.6, 0.3] as const;
const BLADE_MM = 0.82;

const ringsFrom = (from: number): number[] => {
  const rings: number[] = [];
  for (let z = from; z <= LENGTH_MM; z *= 1.18) rings.push(z);
  return rings;
};

function turned(profile: readonly (readonly [number, number])[], sides = 12): THREE.BufferGeometry {
  const points = profile.map(([radius, z]) => new THREE.Vector2(radius, z));
  const geometry = new THREE.LatheGeometry(points, sides);
  geometry.rotateX(Math.PI / 2);
  return geometry;
}

/** From its end to its hinge. A punch's is square: it bites up to its end. */
const SPOON = [
  [0, 0],
  [0.45, 0.25],
  [0.8, 1],
  [0.95, 2],
  [1, JAW_MM],
] as const;
const BASKET = [
  [0, 0],
  [0.78, 0.05],
  [0.95, 0.35],
  [1, 1],
  [1, 2],
  [1, JAW_MM],
] as const;

/** One of two, about its hinge: half of a round, flat towards the other. */
function jaw(
  side: 1 | -1,
  openRad: number,
  profile: readonly (readonly [number, number])[],
): THREE.BufferGeometry {
  const shape = turned(profile);
  const place = shape.getAttribute("position");
  for (let i = 0; i < place.count; ++i) place.setX(i, side * Math.max(0.06, side * place.getX(i)));
  shape.translate(0, 0, -JAW_MM);
  shape.rotateY(-side * openRad);
  shape.translate(0, 0, JAW_MM);
  shape.computeVertexNormals();
  return shape;
}

function finished(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const { count } = geometry.getAttribute("position");
  geometry.setAttribute("lining", new THREE.BufferAttribute(new Float32Array(4 * count), 4));
  geometry.setAttribute("fibre", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  geometry.setAttribute("rest", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  return geometry;
}

function punch(openRad: number): THREE.BufferGeometry {
  return withShaft(jaw(1, openRad, BASKET), jaw(-1, 0, BASKET));
}

function forceps(openRad: number): THREE.BufferGeometry {
  return withShaft(jaw(1, openRad, SPOON), jaw(-1, openRad, SPOON));
}

function withShaft(...jaws: readonly THREE.BufferGeometry[]): THREE.BufferGeometry {
  const shaft = turned([
    [0, JAW_MM - 0.4],
    ...ringsFrom(JAW_MM).map((z) => [FORCEPS_MM, z] as const),
  ]);
  return finished(mergeGeometries([...jaws, shaft]));
}

/** A tube whose window is on the side of +x, and the blade in it: turned away it leaves the window open. */
function shaver(bladeShuts: boolean): THREE.BufferGeometry {
  const [from, to, deep] = WINDOW_MM;
  const rings = [0, 0.12, 0.25, 0.5, 0.9, 1.3, 1.7, 2.1, 2.4, 2.6, ...ringsFrom(3)];
  const profile = rings.map(
    (z) => [z < 1 ? Math.sqrt(1 - (1 - z) ** 2) * SHAVER_MM : SHAVER_MM, z] as const,
  );
  const tube = turned(profile, 20);
  const dark = cutAway(tube, (z) => (z > from && z < to ? deep : Infinity));
  const inner = turned(
    profile.filter(([, z]) => z > 0.1 && z < 3.2).map(([r, z]) => [r * BLADE_MM, z] as const),
    12,
  );
  // Its teeth.
  const at = inner.getAttribute("position");
  for (let v = 0; v < at.count; ++v) {
    const edge = bladeShuts ? 0.55 : deep - 0.2;
    const teeth = 0.12 * Math.sin(9 * at.getZ(v));
    if (at.getX(v) > edge + teeth) at.setX(v, edge + teeth);
  }
  inner.computeVertexNormals();
  const made = mergeGeometries([tube, inner]);
  const ready = finished(made);
  const lining = ready.getAttribute("lining");
  dark.forEach((isDark, v) => {
    if (isDark) lining.setW(v, 1);
  });
  return ready;
}

/** Flattens what lies beyond a plane across +x. @returns  by vertex, whether it was cut */
function cutAway(shape: THREE.BufferGeometry, planeAt: (z: number) => number): readonly boolean[] {
  const at = shape.getAttribute("position");
  const cut = Array.from({ length: at.count }, (_, v) => at.getX(v) > planeAt(at.getZ(v)));
  cut.forEach((isCut, v) => {
    if (isCut) at.setX(v, planeAt(at.getZ(v)));
  });
  shape.computeVertexNormals();
  return cut;
}

/** What makes a portal, by the parts that it has on its axis. */
export function rodOf(parts: readonly InstrumentPart[]): THREE.BufferGeometry {
  const [first] = parts;
  const profile = parts
    .filter((part) => part.from_mm < LENGTH_MM)
    .flatMap((part) => {
      const { from_mm: from, to_mm: to, radius_mm: at, end_radius_mm: end } = part;
      const zs = [from, ...ringsFrom(0.5).filter((z) => z > from && z < to), to];
      return zs.map((z) => [at + ((end - at) * (z - from)) / (to - from || 1), z] as const);
    });
  const made = turned(profile);
  const [across, up] = first?.squash ?? [1, 1];
  made.scale(across ?? 1, up ?? 1, 1);
  made.computeVertexNormals();
  return finished(made);
}

export function rodGeometries(): Readonly<Record<RodLook, THREE.BufferGeometry>> {
  return {
    probe: finished(
      turned([[0, 0], [0.35, 0.15], ...ringsFrom(0.5).map((z) => [PROBE_MM, z] as const)]),
    ),
    open: forceps(OPEN_RAD),
    closed: forceps(0),
    punch_open: punch(PUNCH_OPEN_RAD),
    punch_closed: punch(0),
    shaver: shaver(false),
    blade: shaver(true),
  };
}

/** Of what a hand holds that has no mouth. */
export function rodLook(kind: ToolKind, isClosed: boolean): RodLook {
  if (kind === "punch") return isClosed ? "punch_closed" : "punch_open";
  if (kind !== "grasper") return "probe";
  return isClosed ? "closed" : "open";
}

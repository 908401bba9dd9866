// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Shapes that stand in a joint, turned inside out as the joint's wall is, so that the same material shows
// their outside.
import * as THREE from "three";

/** Every triangle the other way round, and its normals. Takes it without an index. */
export function insideOut(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const made = geometry.index === null ? geometry : geometry.toNonIndexed();
  for (const name of Object.keys(made.attributes)) {
    const values = made.getAttribute(name);
    const size = values.itemSize;
    for (let v = 0; v + 2 < values.count; v += 3) {
      for (let c = 0; c < size; ++c) {
        const second = values.getComponent(v + 1, c);
        values.setComponent(v + 1, c, values.getComponent(v + 2, c));
        values.setComponent(v + 2, c, second);
      }
    }
  }
  const normal = made.getAttribute("normal");
  for (let v = 0; v < normal.count; ++v)
    normal.setXYZ(v, -normal.getX(v), -normal.getY(v), -normal.getZ(v));
  return made;
}

/** What lines it is the same all over; it has no fibres. @param slot  of the four weights; none: synovium */
export function linedAs(
  geometry: THREE.BufferGeometry,
  slot: number | undefined,
): THREE.BufferGeometry {
  const { count } = geometry.getAttribute("position");
  const lining = new Float32Array(4 * count);
  if (slot !== undefined) for (let v = 0; v < count; ++v) lining[4 * v + slot] = 1;
  geometry.setAttribute("lining", new THREE.BufferAttribute(lining, 4));
  geometry.setAttribute("fibre", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  return geometry;
}

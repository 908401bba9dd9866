// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a screw goes through what lines a joint: the wall is left out there, its rim is worn cartilage, and
// over a buried screw the way down to it is seen.
import * as THREE from "three";
import type { ControlledScrew } from "../protocol";
import type { JointWall } from "./joint_wall";
import { band, lined } from "./screw_shape";

export interface HoleUniforms {
  readonly screwTail: THREE.IUniform<THREE.Vector4>;
  readonly screwTip: THREE.IUniform<THREE.Vector4>;
  readonly screwLong: THREE.IUniform<number>;
  readonly [name: string]: THREE.IUniform;
}

export function holeUniforms(): HoleUniforms {
  return {
    screwTail: { value: new THREE.Vector4() },
    screwTip: { value: new THREE.Vector4() },
    screwLong: { value: 0 }, // none
  };
}

export function setHole(uniforms: HoleUniforms, screw: ControlledScrew | null): void {
  uniforms.screwLong.value = screw?.length_mm ?? 0;
  if (screw === null) return;
  uniforms.screwTail.value.set(...screw.tail_mm, screw.tail_radius_mm);
  uniforms.screwTip.value.set(...screw.tip_mm, screw.tip_radius_mm);
}

/**
 * Of the wall on the bone's own side, by which way it looks: what lies opposite stays whole. Before the
 * trailing end its way in is open too.
 */
export const HOLE_GLSL = /* glsl */ `
uniform vec4 screwTail, screwTip;
uniform float screwLong;

void cutByScrew(vec3 n, inout vec3 albedo, inout float rough) {
  if (screwLong <= 0.0) return;
  vec3 way = (screwTip.xyz - screwTail.xyz) / screwLong;
  float along = dot(vRest - screwTail.xyz, way);
  if (along < -6.0 || along > screwLong + 0.3) return;
  vec3 aside = vRest - screwTail.xyz - way * along;
  float off = length(aside);
  float thick = mix(screwTail.w, screwTip.w, clamp(along / screwLong, 0.0, 1.0));
  if (off > thick + 1.2) return;
  vec3 out_of = along < 4.0 ? -way : (along > screwLong - 2.0 ? way + aside / max(off, 1e-3) : aside / max(off, 1e-3));
  if (dot(n, out_of) < 0.05) return;
  float edge = thick + 0.06 + 0.12 * (noise(vRest * 5.0) - 0.5);
  if (off < edge) discard;
  // The drill and the thread have frayed the rim: yellow, a little red, dull.
  float rim = 1.0 - smoothstep(0.05, 0.75, off - edge + 0.3 * (noise(vRest * 8.0) - 0.5));
  vec3 worn = mix(vec3(0.93, 0.88, 0.74), vec3(0.76, 0.48, 0.36), smoothstep(0.4, 0.8, noise(vRest * 6.0 + 4.0)));
  albedo = mix(albedo, worn, 0.8 * rim);
  albedo *= mix(1.0, 0.6, 1.0 - smoothstep(0.0, 0.16, off - edge));
  rough = mix(rough, 0.5, rim);
}
`;

const AROUND = 24;
const FROM_MM = 4; // within the bone, along the screw
const REACH_MM = 10;
const CARTILAGE_MM = 0.7;
const UNDER_TAIL_MM = 0.6;
const MOST_SLOPED_MM = 1.5;

/** Rings of the way in, from the joint's surface to the trailing end; undefined where that stands out of it. */
export function wayIn(
  screw: ControlledScrew,
  walls: readonly JointWall[],
): THREE.BufferGeometry | undefined {
  const tail = new THREE.Vector3(...screw.tail_mm);
  const way = new THREE.Vector3(...screw.tip_mm).sub(tail).normalize();
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), way);
  const radius = screw.tail_radius_mm + 0.05;
  const surfaces = walls.map((wall) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", wall.geometry.getAttribute("rest"));
    geometry.setIndex(wall.geometry.getIndex());
    return new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
  });
  const ray = new THREE.Raycaster();
  ray.far = REACH_MM;
  const tops = Array.from({ length: AROUND }, (_, i) => {
    const angle = (2 * Math.PI * i) / AROUND;
    const from = new THREE.Vector3(radius * Math.cos(angle), radius * Math.sin(angle), FROM_MM)
      .applyQuaternion(turn)
      .add(tail);
    ray.set(from, way.clone().negate());
    const hit = ray.intersectObjects(surfaces)[0];
    return hit === undefined ? undefined : FROM_MM - hit.distance;
  });
  for (const { geometry, material } of surfaces) {
    geometry.dispose();
    material.dispose();
  }
  const known = tops.filter((z) => z !== undefined).sort((a, b) => a - b);
  const middle = known[Math.floor(known.length / 2)];
  // Too few: no wall is there. Above the end: it is metal that is seen.
  if (middle === undefined || known.length < AROUND / 2 || middle > 0) return undefined;
  /** What passes the bone's edge meets the wall opposite: no rim of the hole. */
  const top = (angle: number): number => {
    const z = tops[Math.round((angle / (2 * Math.PI)) * AROUND) % AROUND] ?? middle;
    return Math.min(UNDER_TAIL_MM, Math.abs(z - middle) > MOST_SLOPED_MM ? middle : z);
  };
  const down = (share: number): ((angle: number) => readonly [number, number]) => {
    return (angle) => [radius, top(angle) + (UNDER_TAIL_MM - top(angle)) * share];
  };
  const shares = [0, 0.2, 0.4, 0.7, 1];
  const geometry = band(shares.map(down), AROUND);
  return lined(geometry, (vertex) => {
    const share = shares[Math.floor(vertex / (AROUND + 1))] ?? 1;
    const deep = share * (UNDER_TAIL_MM - middle);
    return deep < CARTILAGE_MM ? [1, 0, 0, 0] : [0, 0, 0, 1];
  });
}

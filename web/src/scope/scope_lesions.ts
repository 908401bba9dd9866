// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong in a joint, as the host says it (generated), for the scope's picture: painted on the wall by
// where each place of it was as scanned, so that it goes with the tissue.
import * as THREE from "three";
import type { BodyPose, ScopeMessage } from "../protocol";
import type { JointWall } from "./joint_wall";
import type { Plan } from "./scope_plan";
import { partsFrom, sideAt, sideOf, type Side } from "./wall_sides";

export type Lesion = Plan["lesions"][number];

/** What is painted of one. */
export interface Painted extends Pick<
  Lesion,
  "look" | "joint" | "from_mm" | "to_mm" | "radius_mm"
> {
  /** Of the joint that it lies on: the other one may touch it as scanned. */
  readonly side: Side;
  /** Torn between two bones, by their places in the case's order: as these part, it gapes. */
  readonly between?: readonly [number, number] | undefined;
}

type Walls = readonly Pick<JointWall, "joint" | "sides">[];

/** Of cartilage that was bitten [mm]: about a punch's width. */
const SCUFF_MM = 0.9;

/** Of one joint; more are not painted. */
export const MOST_PAINTED = 12;
/** Of them between bones that part. */
const MOST_GAPING = 4;
/** So far from the torn line itself [mm]. */
const GAPES_MM = "6.0";

/** What `look` is to the shader; a loose body is no paint. */
const PAINT: Readonly<Record<string, number>> = {
  stain: 0,
  tear: 1,
  worn: 2,
  soft: 3,
  fissured: 4,
  frayed: 5,
  bare: 6,
};

export interface LesionUniforms {
  readonly lesionFrom: THREE.IUniform<THREE.Vector4[]>;
  readonly lesionTo: THREE.IUniform<THREE.Vector4[]>;
  /** Its side; which of the pairs of bones it gapes between, -1 for none. */
  readonly lesionOn: THREE.IUniform<THREE.Vector2[]>;
  readonly lesionCount: THREE.IUniform<number>;
  /** Two after each other: where bones have the wall as scanned. */
  readonly gaping: THREE.IUniform<THREE.Matrix4[]>;
  readonly [name: string]: THREE.IUniform;
}

export function lesionUniforms(): LesionUniforms {
  const many = <T>(length: number, one: () => T): { value: T[] } => ({
    value: Array.from({ length }, one),
  });
  return {
    lesionFrom: many(MOST_PAINTED, () => new THREE.Vector4()),
    lesionTo: many(MOST_PAINTED, () => new THREE.Vector4()),
    lesionOn: many(MOST_PAINTED, () => new THREE.Vector2()),
    lesionCount: { value: 0 },
    gaping: many(2 * MOST_GAPING, () => new THREE.Matrix4()),
  };
}

/** @param bodies  names, in the case's order */
export function paintOf(
  lesions: readonly Lesion[],
  walls: Walls,
  bodies: readonly string[],
): readonly Painted[] {
  return lesions.flatMap((lesion) => {
    const wall = walls.find(({ joint }) => joint === lesion.joint)?.sides;
    if (wall === undefined || PAINT[lesion.look] === undefined) return [];
    const body = bodies.indexOf(lesion.body);
    const other =
      lesion.look === "tear" ? partsFrom(wall, body, lesion.from_mm, lesion.to_mm) : undefined;
    const between = other === undefined ? undefined : ([body, other] as const);
    return [{ ...lesion, side: sideOf(wall, body), between }];
  });
}

const ONE = new THREE.Vector3(1, 1, 1);
const turn = new THREE.Quaternion();
const moved = new THREE.Vector3();

/** Those of one joint. @param poses  of the bodies, in the case's order */
export function setLesions(
  uniforms: LesionUniforms,
  lesions: readonly Painted[],
  joint: string,
  poses: readonly BodyPose[],
): void {
  let count = 0;
  let pairs = 0;
  for (const lesion of lesions) {
    const paint = PAINT[lesion.look];
    if (lesion.joint !== joint || paint === undefined || count >= MOST_PAINTED) continue;
    uniforms.lesionFrom.value[count]?.set(...lesion.from_mm, lesion.radius_mm);
    uniforms.lesionTo.value[count]?.set(...lesion.to_mm, paint);
    const gapes = lesion.between !== undefined && pairs < MOST_GAPING;
    uniforms.lesionOn.value[count]?.set(lesion.side, gapes ? pairs : -1);
    if (gapes) {
      lesion.between.forEach((body, i) => {
        const { quaternion: [w, x, y, z] = [1, 0, 0, 0], translation_mm: at = [0, 0, 0] } =
          poses[body] ?? {};
        uniforms.gaping.value[2 * pairs + i]?.compose(moved.set(...at), turn.set(x, y, z, w), ONE);
      });
      ++pairs;
    }
    ++count;
  }
  uniforms.lesionCount.value = count;
}

/** Bitten cartilage hangs in fronds. */
export function scuffed(scuffs: ScopeMessage["scuffs"], walls: Walls): readonly Painted[] {
  return scuffs.map(({ joint, at_mm: at }) => {
    const wall = walls.find((one) => one.joint === joint)?.sides;
    return {
      look: "frayed",
      joint,
      from_mm: at,
      to_mm: at,
      radius_mm: SCUFF_MM,
      side: wall === undefined ? 0 : sideAt(wall, at),
    };
  });
}

/** Changes colour, roughness and wetness (1 wet, 0 a hole that nothing shines from). */
export const LESIONS_GLSL = /* glsl */ `
uniform vec4 lesionFrom[${MOST_PAINTED}];
uniform vec4 lesionTo[${MOST_PAINTED}];
uniform vec2 lesionOn[${MOST_PAINTED}];
uniform int lesionCount;
uniform mat4 gaping[${2 * MOST_GAPING}];
varying vec3 vRest;
varying float vShare;

void paintLesions(inout vec3 albedo, inout float rough, inout float wet) {
  for (int i = 0; i < ${MOST_PAINTED}; ++i) {
    if (i >= lesionCount) break;
    vec3 a = lesionFrom[i].xyz, along = lesionTo[i].xyz - a;
    float radius = lesionFrom[i].w, look = lesionTo[i].w;
    // Its own side of the joint; where a ligament runs from one side to the other, more of it.
    float most = look < 2.5 ? mix(0.5, 1.0, vLining.z) : 0.5;
    float here = 1.0 - smoothstep(most - 0.15, most, abs(vShare - lesionOn[i].x));
    if (here <= 0.0) continue;
    float whole = max(dot(along, along), 1e-6);
    float off = length(vRest - a - along * clamp(dot(vRest - a, along) / whole, 0.0, 1.0));
    // Between bones that part the wall is drawn out: no tissue is there. What is left hangs on a bone, and its
    // grain goes with that one.
    int pair = int(lesionOn[i].y);
    vec3 grain = vRest;
    float gap = 0.0, parted = 0.0;
    if (pair >= 0 && off < ${GAPES_MM}) {
      mat4 bone = gaping[2 * pair];
      vec3 one = (bone * vec4(vRest, 1.0)).xyz;
      vec3 apart = (gaping[2 * pair + 1] * vec4(vRest, 1.0)).xyz - one;
      float apartMm = max(length(apart), 1e-3);
      float from = clamp(dot(vAt - one, apart) / apartMm, 0.0, apartMm);
      parted = smoothstep(0.3, 1.0, apartMm) * (1.0 - smoothstep(0.3, 0.7, vLining.z));
      gap = parted * min(from, apartMm - from) * (1.0 - smoothstep(0.08, 0.20, abs(vShare - lesionOn[i].x)));
      grain = transpose(mat3(bone)) * (vAt - bone[3].xyz);
    }
    if (gap <= 0.0 && off > 2.6 * radius) continue;
    // Tissue is torn ragged; cartilage ends smoothly where it did.
    float frays = 1.0 - 0.75 * parted * vLining.x;
    float ragged = frays * (noise(grain * 3.1 + 5.0) - 0.5);
    float fleck = noise(grain * 9.0);
    float fine = frays * (fleck - 0.5);
    float s = off / radius + 0.45 * ragged + 0.2 * fine + 3.0 * (1.0 - here) + 3.0 * parted;
    if (look < 0.5) {  // bleeding into a ligament: dark in its middle, patches and specks about, swollen and so more glossy
      float t = (1.0 - smoothstep(0.30, 1.20, s)) * (1.0 - 0.85 * vLining.x);
      float clot = noise(vRest * 2.1 + 9.0);
      float blood = smoothstep(0.0, 0.2, t) * smoothstep(0.66 - 0.58 * t, 0.92 - 0.52 * t, 0.7 * clot + 0.3 * fleck);
      albedo = mix(albedo, mix(vec3(0.54, 0.07, 0.05), vec3(0.19, 0.01, 0.02), smoothstep(0.30, 0.70, clot) * t), 0.86 * blood);
      rough = mix(rough, 0.24, t);
    } else if (look < 2.5) {  // a hole: torn, or worn through
      float torn = look < 1.5 ? 1.0 : 0.0;
      float hole = max(1.0 - smoothstep(0.80, 1.0, s), smoothstep(0.28, 0.40, gap + 0.25 * ragged + 0.12 * fine));
      float rim = (1.0 - hole) * max(1.0 - smoothstep(1.15, 1.15 + 0.75, s), smoothstep(0.02, 0.15, gap) * min(1.0, vLining.x + vLining.z));
      float blood = smoothstep(0.45, 0.80, noise(grain * 5.0)) * (1.0 - smoothstep(1.05, 1.45, s));
      vec3 edge = mix(vec3(0.92, 0.84, 0.66), mix(vec3(0.95, 0.91, 0.82), vec3(0.74, 0.30, 0.22), 0.8 * blood), torn);
      albedo = mix(albedo, edge, rim * (0.55 + 0.35 * torn));
      rough = mix(rough, 0.5, rim);
      albedo = mix(albedo, vec3(0.012, 0.005, 0.004), hole);
      wet *= 1.0 - hole;
    } else if (look < 3.5) {  // soft: dull, swollen, a little yellow
      float t = 1.0 - smoothstep(0.55, 1.05, s);
      albedo = mix(albedo, vec3(0.80, 0.72, 0.52), 0.55 * t);
      rough = mix(rough, 0.46, t);
      wet *= 1.0 - 0.6 * t;
    } else if (look < 4.5) {  // fissures
      float t = 1.0 - smoothstep(0.75, 1.05, s);
      float line = abs(2.0 * noise(vRest * 1.7 + 3.0) - 1.0);
      float line2 = abs(2.0 * noise(vRest * 2.9 + 17.0) - 1.0);
      float crack = max(1.0 - smoothstep(0.02, 0.10, line), 0.8 * (1.0 - smoothstep(0.02, 0.08, line2)));
      albedo = mix(albedo, vec3(0.82, 0.74, 0.58), 0.45 * t);
      albedo = mix(albedo, vec3(0.26, 0.15, 0.09), crack * t);
      wet *= 1.0 - 0.8 * crack * t;
    } else if (look < 5.5) {  // fronds, bone between them
      float t = 1.0 - smoothstep(0.80, 1.05, s);
      float frond = smoothstep(0.38, 0.62, noise(vRest * vec3(2.2, 5.0, 5.0) + 2.0 * ragged));
      vec3 crab = mix(vec3(0.62, 0.38, 0.22), vec3(0.95, 0.91, 0.80), frond);
      albedo = mix(albedo, crab, t);
      rough = mix(rough, 0.5, t);
      wet *= 1.0 - 0.5 * t;
    } else {  // bare bone with a rim
      float t = 1.0 - smoothstep(0.88, 0.98, s);
      float rim = (1.0 - t) * (1.0 - smoothstep(1.0, 1.22, s));
      albedo = mix(albedo, vec3(0.97, 0.95, 0.88), 0.7 * rim);
      vec3 bone = mix(vec3(0.84, 0.71, 0.52), vec3(0.80, 0.54, 0.42), 0.7 * smoothstep(0.55, 0.85, noise(vRest * 5.0)));
      albedo = mix(albedo, bone, t);
      rough = mix(rough, 0.42, t);
    }
  }
}
`;

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong in a joint, as the host says it (generated), for the scope's picture: painted on the wall by
// where each place of it was as scanned, so that it goes with the tissue.
import * as THREE from "three";
import type { ScopeMessage } from "../protocol";
import type { Plan } from "./scope_plan";

export type Lesion = Plan["lesions"][number];
/** What is painted of one. */
export type Painted = Pick<Lesion, "look" | "joint" | "from_mm" | "to_mm" | "radius_mm">;

/** Of cartilage that was bitten [mm]: about a punch's width. */
const SCUFF_MM = 0.9;

/** Of one joint; more are not painted. */
export const MOST_PAINTED = 12;

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
  readonly lesionCount: THREE.IUniform<number>;
  readonly [name: string]: THREE.IUniform;
}

export function lesionUniforms(): LesionUniforms {
  const places = (): THREE.Vector4[] =>
    Array.from({ length: MOST_PAINTED }, () => new THREE.Vector4());
  return {
    lesionFrom: { value: places() },
    lesionTo: { value: places() },
    lesionCount: { value: 0 },
  };
}

/** Those of one joint. */
export function setLesions(
  uniforms: LesionUniforms,
  lesions: readonly Painted[],
  joint: string,
): void {
  let count = 0;
  for (const lesion of lesions) {
    const paint = PAINT[lesion.look];
    if (lesion.joint !== joint || paint === undefined || count >= MOST_PAINTED) continue;
    uniforms.lesionFrom.value[count]?.set(...lesion.from_mm, lesion.radius_mm);
    uniforms.lesionTo.value[count]?.set(...lesion.to_mm, paint);
    ++count;
  }
  uniforms.lesionCount.value = count;
}

/** Bitten cartilage hangs in fronds. */
export function scuffed(scuffs: ScopeMessage["scuffs"]): readonly Painted[] {
  return scuffs.map(({ joint, at_mm: at }) => ({
    look: "frayed",
    joint,
    from_mm: at,
    to_mm: at,
    radius_mm: SCUFF_MM,
  }));
}

/** Changes colour, roughness and wetness (1 wet, 0 a hole that nothing shines from). */
export const LESIONS_GLSL = /* glsl */ `
uniform vec4 lesionFrom[${MOST_PAINTED}];
uniform vec4 lesionTo[${MOST_PAINTED}];
uniform int lesionCount;
varying vec3 vRest;

void paintLesions(inout vec3 albedo, inout float rough, inout float wet) {
  for (int i = 0; i < ${MOST_PAINTED}; ++i) {
    if (i >= lesionCount) break;
    vec3 a = lesionFrom[i].xyz, along = lesionTo[i].xyz - a;
    float radius = lesionFrom[i].w, look = lesionTo[i].w;
    float whole = max(dot(along, along), 1e-6);
    float off = length(vRest - a - along * clamp(dot(vRest - a, along) / whole, 0.0, 1.0));
    if (off > 2.6 * radius) continue;
    float ragged = noise(vRest * 3.1 + 5.0) - 0.5;
    float fine = noise(vRest * 9.0) - 0.5;
    float s = off / radius + 0.45 * ragged + 0.2 * fine;
    if (look < 0.5) {  // bleeding into a ligament
      float t = 1.0 - smoothstep(0.35, 1.25, s);
      albedo = mix(albedo, mix(vec3(0.62, 0.13, 0.09), vec3(0.34, 0.03, 0.04), noise(vRest * 2.2)), 0.85 * t);
    } else if (look < 2.5) {  // a hole: torn, or worn through
      float torn = look < 1.5 ? 1.0 : 0.0;
      float hole = 1.0 - smoothstep(0.80, 1.0, s);
      float rim = (1.0 - hole) * (1.0 - smoothstep(1.15, 1.15 + 0.75, s));
      vec3 edge = mix(vec3(0.92, 0.84, 0.66),
                      mix(vec3(0.96, 0.93, 0.86), vec3(0.74, 0.28, 0.20), smoothstep(0.35, 0.75, noise(vRest * 7.0))), torn);
      albedo = mix(albedo, edge, rim * (0.55 + 0.35 * torn));
      rough = mix(rough, 0.5, rim);
      albedo = mix(albedo, vec3(0.035, 0.012, 0.010), hole);
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

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Creases of the palm's side of the wrist (data/skin_creases.json): what an eye finds the volar portals by. Drawn in the
// skin's shader, as scanned, so that they bend with the wrist.
import * as THREE from "three";
import data from "../../../data/skin_creases.json";
import type { Matrix16 } from "../frames";

const { creases } = data;

/** What creases() needs of the fragment; `out` is the skin's normal as scanned. */
export const CREASES_GLSL = /* glsl */ `
uniform mat4 creaseRoomFromPatient;
uniform vec3 creaseLines[${creases.length}]; // distal, bow, depth
/** How much of the skin's light is lost at a place [mm, Patient, as scanned]. */
float creases(vec3 place, vec3 out_, float wander) {
  vec3 at = 1000.0 * (creaseRoomFromPatient * vec4(place, 1.0)).xyz;
  float volar = smoothstep(0.1, 0.6, -normalize(mat3(creaseRoomFromPatient) * out_).z);
  float across = at.x / ${data.half_length_mm.value.toFixed(1)};
  float lost = 0.0;
  for (int i = 0; i < ${creases.length}; ++i) {
    float line = creaseLines[i].x - creaseLines[i].y * across * across + 1.6 * (wander - 0.5);
    float off = (at.y - line) / ${data.half_width_mm.value.toFixed(2)};
    lost = max(lost, creaseLines[i].z * exp(-off * off));
  }
  return lost * volar * smoothstep(1.0, 0.75, abs(across));
}
`;

/** @param rendererFromPatient  of the forearm as scanned: Y distal, Z dorsal, from the distal end of the radius */
export function creaseUniforms(rendererFromPatient: Matrix16) {
  return {
    creaseRoomFromPatient: { value: new THREE.Matrix4().fromArray([...rendererFromPatient]) },
    creaseLines: {
      value: creases.map((one) => new THREE.Vector3(one.distal_mm, one.bow_mm, one.deep)),
    },
  };
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What lies between the tissue and the lens: blood in the fluid, in wisps, that swallows all but red. For
// fragment shaders that have `eye`, NOISE_GLSL.
export const FLUID_GLSL = /* glsl */ `
uniform vec4 water; // optical depths: of blood by mm, mist, blood on the lens; 1 where it is dry
uniform float drift; // s
/** @param depth  of the way, unevenly filled */
vec3 throughBlood(vec3 colour, vec3 at) {
  for (int i = ifAny(water.x - 0.0005); i > 0; --i) {
    vec3 way = at - eye;
    // Where the way is half done: one cloud stands for all along it.
    vec3 half_way = eye + 0.55 * way;
    float wisp = noise(half_way * 0.26 + vec3(0.0, 0.09 * drift, 0.05 * drift));
    wisp = 0.72 * wisp + 0.28 * noise(half_way * 0.7 + vec3(0.08 * drift, 0.0, -0.11 * drift));
    float depth = water.x * length(way) * (0.45 + 1.1 * wisp);
    vec3 kept = exp(-depth * vec3(0.78, 1.12, 1.18));
    vec3 shining = vec3(0.085, 0.021, 0.016) * (0.7 + 0.6 * wisp);
    colour = colour * kept + shining * (1.0 - exp(-0.8 * depth));
  }
  return colour;
}
`;

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What lies between the tissue and the camera: blood in the fluid, in wisps, that swallows all but red; mist
// and blood on the lens. For fragment shaders that have `eye`, `noise(vec3)`.
export const FLUID_GLSL = /* glsl */ `
uniform vec4 water; // optical depths: of blood by mm, mist, blood on the lens; 1 where it is dry
uniform float drift; // s
/** @param depth  of the way, unevenly filled */
vec3 throughBlood(vec3 colour, vec3 at) {
  if (water.x < 0.0005) return colour;
  vec3 way = at - eye;
  // Where the way is half done: one cloud stands for all along it.
  vec3 half_way = eye + 0.55 * way;
  float wisp = noise(half_way * 0.26 + vec3(0.0, 0.09 * drift, 0.05 * drift));
  wisp = 0.72 * wisp + 0.28 * noise(half_way * 0.7 + vec3(0.08 * drift, 0.0, -0.11 * drift));
  float depth = water.x * length(way) * (0.45 + 1.1 * wisp);
  vec3 kept = exp(-depth * vec3(0.78, 1.12, 1.18));
  vec3 shining = vec3(0.085, 0.021, 0.016) * (0.7 + 0.6 * wisp);
  return colour * kept + shining * (1.0 - exp(-0.8 * depth));
}
/** @param at  on the screen, the rim at 1. @param colour  as the camera has it */
vec3 throughLens(vec3 colour, vec2 at) {
  if (water.y + water.z < 0.01) return colour;
  // Turned, so that no grid shows.
  vec2 p = mat2(0.8, 0.6, -0.6, 0.8) * at;
  float beads = noise(vec3(p * 9.0, 9.0));
  float mottled = 0.65 * noise(vec3(p * 2.7, 3.0)) + 0.35 * beads;
  // Mist clears from the middle.
  float mist = 1.0 - exp(-water.y * (0.4 + 0.5 * mottled + 0.6 * dot(at, at)));
  colour = mix(colour, vec3(0.30, 0.31, 0.32) * (0.9 + 0.2 * mottled), mist);
  // Blood lies in streaks that leave gaps, fewer and fewer.
  vec2 drawn = p + 0.35 * vec2(noise(vec3(p * 1.9, 5.2)), noise(vec3(p * 1.9, 8.4)));
  float streak = 0.75 * noise(vec3(drawn * vec2(1.6, 3.4), 1.7)) + 0.25 * noise(vec3(drawn * vec2(4.1, 8.3), 2.9));
  float most = 0.30 * min(water.z, 2.0);
  float blot = smoothstep(0.66 - most, 0.86 - most, streak);
  float smear = 1.0 - exp(-water.z * (0.08 + 1.5 * blot));
  return mix(colour, vec3(0.15, 0.014, 0.008) * (0.75 + 0.5 * streak), smear);
}`;

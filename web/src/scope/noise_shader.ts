// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Smooth noise of 0 to 1 in space, for fragment shaders. Most of the picture's cost where a processor draws:
// each axis is hashed once for the four corners that share it. Where a place has none of what it is for, it
// is left out by a loop of no turns, `for (int i = ifAny(share); i > 0; --i)`: a processor that draws goes
// through both sides of an `if`.
export const NOISE_GLSL = /* glsl */ `
int ifAny(float share) { return share > 0.0 ? 1 : 0; }
float noise(vec3 p) {
  const vec3 kStep = vec3(0.1031, 0.1030, 0.0973);
  vec3 i = floor(p);
  vec3 f = p - i;
  f = f * f * (3.0 - 2.0 * f);
  vec3 a = fract(i * kStep);
  vec3 b = fract((i + 1.0) * kStep);
  vec4 x = vec4(a.x, b.x, a.x, b.x);
  vec4 y = vec4(a.yy, b.yy);
  vec4 sum = x + y;
  vec4 flat_part = 2.0 * x * y + 33.33 * sum;
  vec4 low = flat_part + a.z * (a.z + 33.33);
  vec4 high = flat_part + b.z * (b.z + 33.33);
  low = fract((sum + 2.0 * low) * (a.z + low));
  high = fract((sum + 2.0 * high) * (b.z + high));
  vec4 level = mix(low, high, f.z);
  vec2 row = mix(level.xy, level.zw, f.y);
  return mix(row.x, row.y, f.x);
}
`;

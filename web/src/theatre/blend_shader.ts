// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// blendedPoint() of skin_blend_model.ts for the vertex shaders of what bends with the wrist.

/** What a shader needs before blendBegin(): the two motions. */
export const BLEND_DECLARATIONS = /* glsl */ `
uniform vec4 forearmReal;
uniform vec4 forearmDual;
uniform vec4 handReal;
uniform vec4 handDual;
vec4 blendReal;
vec4 blendDual;
void blendBegin(float share) {
  float side = dot(forearmReal, handReal) < 0.0 ? -1.0 : 1.0;
  blendReal = mix(forearmReal, side * handReal, share);
  blendDual = mix(forearmDual, side * handDual, share);
  float size = length(blendReal);
  blendReal /= size;
  blendDual /= size;
}
vec3 blendTurned(vec3 v) {
  return v + 2.0 * cross(blendReal.xyz, cross(blendReal.xyz, v) + blendReal.w * v);
}
vec3 blendMoved(vec3 p) {
  return blendTurned(p) + 2.0 * (blendReal.w * blendDual.xyz - blendDual.w * blendReal.xyz
    + cross(blendReal.xyz, blendDual.xyz));
}
`;

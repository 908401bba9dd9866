// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a scope sees behind everything: outside the skin that its lamp lights, with the portal's mark; inside
// the joint what it came through, where the wall has its hole.
import * as THREE from "three";
import { FLUID_GLSL } from "./fluid_shader";
import { NOISE_GLSL } from "./noise_shader";
import { LAMP, type LensUniforms } from "./scope_shader";

const VERTEX = /* glsl */ `
varying vec2 vAt;
void main() {
  vAt = position.xy;
  gl_Position = vec4(position.xy, 0.999, 1.0);
}`;

const FRAGMENT = /* glsl */ `
precision highp float;
uniform vec3 eye, axis, up, right, lamp, skin, inwards;
uniform float halfField, isOutside, exposure;
varying vec2 vAt;
float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
float noise(vec2 p) {
  vec2 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x),
             mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
}
${NOISE_GLSL}${FLUID_GLSL}
// What the scope came through, where the joint's wall has its hole: synovium and fat, as far away as they
// would hang about the shaft, lit as the wall is.
vec3 tract(vec3 way) {
  const float kAwayMm = 6.0;
  vec3 at = eye + way * kAwayMm;
  float soft = 0.65 * noise(at * 0.8) + 0.35 * noise(at * 1.9 + 7.1);
  float villi = noise(at * 2.6);
  vec3 synovium = mix(vec3(0.46, 0.12, 0.09), vec3(0.72, 0.34, 0.25), 0.5 * soft + 0.5 * villi);
  vec3 fat = mix(vec3(0.66, 0.32, 0.18), vec3(0.80, 0.50, 0.32), villi);
  vec3 albedo = mix(synovium, fat, 0.7 * smoothstep(0.50, 0.72, noise(at * 0.45 + 3.3)));
  float cone = mix(0.15, 1.0, smoothstep(0.55, 0.95, dot(way, axis)));
  float e = ${LAMP} * (cone / (kAwayMm * kAwayMm + 11.0) + 0.0032);
  // Folds: what turns away from the light is darker, and all of it lies beside the lamp.
  float fold = 0.12 + 0.45 * smoothstep(0.25, 0.75, 0.6 * soft + 0.4 * noise(at * 1.1 + 19.0));
  return albedo * (0.75 * e * fold + 0.03) * exposure;
}
void main() {
  float r = length(vAt);
  if (r > 1.0) discard;
  float angle = r * halfField;
  vec2 aside = r > 1e-6 ? vAt / r * sin(angle) : vec2(0.0);
  vec3 way = right * aside.x + up * aside.y + axis * cos(angle);
  vec3 colour;
  if (isOutside > 0.5) {
    float towards = dot(way, inwards);
    colour = vec3(0.004);
    if (towards > 0.02) {
      vec3 at = eye + way * (dot(skin - eye, inwards) / towards);
      vec3 e1 = normalize(abs(inwards.x) < 0.8 ? cross(inwards, vec3(1, 0, 0)) : cross(inwards, vec3(0, 1, 0)));
      vec3 e2 = cross(inwards, e1);
      vec2 uv = vec2(dot(at - skin, e1), dot(at - skin, e2));
      vec3 to = at - lamp;
      float d2 = dot(to, to);
      float cone = smoothstep(0.50, 0.95, dot(to, axis) * inversesqrt(d2));
      float e = 1100.0 * cone / (d2 + 60.0);
      float pores = 0.5 * noise(uv * 2.2) + 0.3 * noise(uv * 5.1) + 0.2 * noise(uv * 0.6);
      colour = mix(vec3(0.42, 0.24, 0.17), vec3(0.66, 0.42, 0.32), pores) * (0.04 + e);
      float ring = length(uv) + 0.3 * noise(uv * 3.0);
      colour *= mix(vec3(1.0), vec3(0.25, 0.18, 0.55), 0.8 * (1.0 - smoothstep(0.3, 0.5, abs(ring - 2.6))));
    }
  } else {
    colour = throughBlood(tract(way), eye + 6.0 * way);
  }
  colour *= 1.0 - 0.45 * pow(r, 3.5);
  colour = clamp((colour * (2.51 * colour + 0.03)) / (colour * (2.43 * colour + 0.59) + 0.14), 0.0, 1.0);
  colour *= 1.0 - smoothstep(0.985, 1.0, r);
  gl_FragColor = vec4(pow(colour, vec3(1.0 / 2.2)), 1.0);
}`;

export class ScopeBackdrop {
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;
  private readonly skin = { value: new THREE.Vector3() };
  private readonly inwards = { value: new THREE.Vector3(0, 0, 1) };
  private readonly isOutside = { value: 0 };

  constructor(lens: LensUniforms) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute(
      "position",
      new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3),
    );
    this.mesh = new THREE.Mesh(
      geometry,
      new THREE.ShaderMaterial({
        name: "scope backdrop",
        uniforms: {
          ...lens,
          skin: this.skin,
          inwards: this.inwards,
          isOutside: this.isOutside,
        },
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        depthWrite: false,
      }),
    );
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 0.5; // after what is opaque: only where nothing of it is
  }

  /** @param skinMm  of the portal that the lens is before, with the way in; undefined: it is in the body */
  setOutside(skinMm: readonly number[] | undefined, inwards: readonly number[]): void {
    this.isOutside.value = skinMm === undefined ? 0 : 1;
    if (skinMm !== undefined) this.skin.value.fromArray(skinMm);
    this.inwards.value.fromArray(inwards);
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a scope sees behind everything: outside the skin that its lamp lights, with the portal's mark; inside
// the joint the capsule, where the wall leaves a gap.
import * as THREE from "three";
import type { LensUniforms } from "./scope_shader";

const VERTEX = /* glsl */ `
varying vec2 vAt;
void main() {
  vAt = position.xy;
  gl_Position = vec4(position.xy, 0.999, 1.0);
}`;

const FRAGMENT = /* glsl */ `
precision highp float;
uniform vec3 eye, axis, up, right, lamp, skin, inwards;
uniform float halfField, isOutside;
varying vec2 vAt;
float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
float noise(vec2 p) {
  vec2 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x),
             mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
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
    vec2 uv = vec2(atan(way.y, way.x), way.z) * 4.0;
    float soft = 0.6 * noise(uv) + 0.4 * noise(uv * 2.7);
    colour = mix(vec3(0.10, 0.035, 0.025), vec3(0.24, 0.11, 0.08), soft);
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
        uniforms: {
          ...lens,
          skin: this.skin,
          inwards: this.inwards,
          isOutside: this.isOutside,
        },
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        depthTest: false,
        depthWrite: false,
      }),
    );
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -1;
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

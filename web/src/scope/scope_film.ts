// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Mist and blood on the scope's lens, over the whole picture; not drawn where the lens is clean.
import * as THREE from "three";
import { NOISE_GLSL } from "./noise_shader";
import type { LensUniforms } from "./scope_shader";

/** Less does not show. */
const LEAST_DEPTH = 0.01;

const VERTEX = /* glsl */ `
varying vec2 vAt;
void main() {
  vAt = position.xy;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

const FRAGMENT = /* glsl */ `
precision highp float;
uniform vec4 water; // as fluid_shader.ts has it
varying vec2 vAt;
${NOISE_GLSL}
void main() {
  float r = length(vAt);
  if (r > 1.0) discard;
  // Turned, so that no grid shows.
  vec2 p = mat2(0.8, 0.6, -0.6, 0.8) * vAt;
  float beads = noise(vec3(p * 9.0, 9.0));
  float mottled = 0.65 * noise(vec3(p * 2.7, 3.0)) + 0.35 * beads;
  // Mist clears from the middle.
  float mist = 1.0 - exp(-water.y * (0.4 + 0.5 * mottled + 0.6 * r * r));
  vec3 misty = vec3(0.30, 0.31, 0.32) * (0.9 + 0.2 * mottled);
  // Blood lies in streaks that leave gaps, fewer and fewer.
  vec2 drawn = p + 0.35 * vec2(noise(vec3(p * 1.9, 5.2)), noise(vec3(p * 1.9, 8.4)));
  float streak = 0.75 * noise(vec3(drawn * vec2(1.6, 3.4), 1.7)) + 0.25 * noise(vec3(drawn * vec2(4.1, 8.3), 2.9));
  float most = 0.30 * min(water.z, 2.0);
  float blot = smoothstep(0.66 - most, 0.86 - most, streak);
  float smear = 1.0 - exp(-water.z * (0.08 + 1.5 * blot));
  vec3 bloody = vec3(0.15, 0.014, 0.008) * (0.75 + 0.5 * streak);
  float covered = 1.0 - (1.0 - mist) * (1.0 - smear);
  vec3 colour = mix(misty * mist, bloody, smear) / max(covered, 1e-3);
  colour *= 1.0 - smoothstep(0.985, 1.0, r);
  gl_FragColor = vec4(pow(colour, vec3(1.0 / 2.2)), covered);
}`;

export class ScopeFilm {
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;

  constructor(private readonly lens: LensUniforms) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute(
      "position",
      new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3),
    );
    this.mesh = new THREE.Mesh(
      geometry,
      new THREE.ShaderMaterial({
        name: "scope film",
        uniforms: lens,
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        transparent: true,
        depthTest: false,
        depthWrite: false,
      }),
    );
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 2; // over what drifts in the fluid too
  }

  /** Before each picture. @param isOutside  before the skin the lens is clean */
  lay(isOutside: boolean): void {
    const { y: mist, z: blood } = this.lens.water.value;
    this.mesh.visible = !isOutside && mist + blood >= LEAST_DEPTH;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluid in the scope's picture: how much blood, mist and smear the shaders show, and, in one instanced draw
// call, bubbles and what drifts. The host says how much of each there is.
import * as THREE from "three";
import type { JointFluid } from "../protocol";
import { highestPlaces, type BubbleView } from "./fluid_model";
import type { LensUniforms } from "./scope_shader";

const MOST_BUBBLES = 16;
const MOST_FLECKS = 28;
const MOST = MOST_BUBBLES + MOST_FLECKS;
/** Haze that shows all flecks [1/mm]. */
const FLECKS_AT_HAZE = 0.15;
const FEWEST_FLECKS = 5;
/** How often bubbles look for the highest place [ms]. */
const COLLECTED_MS = 400;

const VERTEX = /* glsl */ `
uniform vec3 eye, axis, up, right;
uniform float halfField, drift;
attribute vec4 place; // of a bubble where it is, of a fleck anywhere in a box about the eye; its radius
attribute float isBubble;
varying vec2 vCorner;
varying float vBubble, vFar, vShade;
const float kBoxMm = 14.0;
void main() {
  vec3 at = place.xyz;
  if (isBubble < 0.5) {
    vec3 flow = vec3(0.021, 0.013, -0.009) * (0.5 + place.y);
    at = eye + (fract(at + flow * drift - eye / kBoxMm) - 0.5) * kBoxMm;
  }
  vec3 to = at - eye;
  vec3 seen = vec3(dot(to, right), dot(to, up), dot(to, axis));
  float aside = length(seen.xy);
  float angle = atan(aside, seen.z);
  vec2 round = aside > 1e-6 ? seen.xy / aside * (angle / halfField) : vec2(0.0);
  float far = length(to);
  round += position.xy * place.w / max(far, 0.5) / halfField;
  gl_Position = vec4(round * far, (2.0 * far / 60.0 - 1.0) * far, far);
  vCorner = position.xy;
  vBubble = isBubble;
  vFar = far;
  vShade = fract(17.0 * place.x + 5.0 * place.w);
}`;

const FRAGMENT = /* glsl */ `
precision highp float;
uniform vec4 water;
varying vec2 vCorner;
varying float vBubble, vFar, vShade;
void main() {
  float r = length(vCorner);
  if (r > 1.0) discard;
  float clear = exp(-0.8 * water.x * vFar);
  if (vBubble > 0.5) {
    // From water its rim throws light back as a mirror does: dark within a thin bright edge.
    float dark = smoothstep(0.45, 0.86, r) * (1.0 - smoothstep(0.90, 0.97, r));
    float edge = smoothstep(0.86, 0.94, r) * (1.0 - smoothstep(0.96, 1.0, r));
    float lamp = 1.0 - smoothstep(0.05, 0.17, length(vCorner - vec2(0.24, 0.38)));
    float mirrored = 0.6 * (1.0 - smoothstep(0.03, 0.12, length(vCorner + vec2(0.30, 0.44))));
    float lit = 0.55 + 0.45 * dot(vCorner, vec2(0.45, 0.7));
    float shine = max(max(lamp, mirrored), edge * lit);
    vec3 colour = mix(vec3(0.16, 0.10, 0.09), vec3(1.0, 0.97, 0.93), shine);
    gl_FragColor = vec4(colour, max(shine, 0.5 * dark + 0.06) * clear);
  } else {
    float soft = (1.0 - r) * (1.0 - r);
    float near = smoothstep(1.0, 2.6, vFar) * (1.0 - smoothstep(5.5, 7.0, vFar));
    vec3 colour = mix(vec3(0.92, 0.84, 0.74), vec3(0.85, 0.45, 0.36), step(0.7, vShade));
    gl_FragColor = vec4(colour, 0.55 * soft * near * clear);
  }
}`;

const CORNERS = [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0];

export class ScopeFluid {
  readonly mesh: THREE.Mesh<THREE.InstancedBufferGeometry, THREE.ShaderMaterial>;
  private readonly place = new THREE.InstancedBufferAttribute(new Float32Array(4 * MOST), 4);
  private readonly isBubble = new THREE.InstancedBufferAttribute(new Float32Array(MOST), 1);
  private fluid: JointFluid | null = null;
  private collectedMs = -Infinity;
  private bubbles = 0;
  private readonly isStill = window.matchMedia("(prefers-reduced-motion: reduce)");

  constructor(private readonly lens: LensUniforms) {
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(CORNERS, 3));
    geometry.setAttribute("place", this.place);
    geometry.setAttribute("isBubble", this.isBubble);
    geometry.instanceCount = 0;
    this.mesh = new THREE.Mesh(
      geometry,
      new THREE.ShaderMaterial({
        name: "scope fluid",
        uniforms: lens,
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        transparent: true,
        depthWrite: false,
      }),
    );
    this.mesh.frustumCulled = false; // the lens is no frustum
    this.mesh.renderOrder = 1;
    this.mesh.visible = false;
  }

  /** null: nothing is between. */
  set(fluid: JointFluid | null): void {
    this.fluid = fluid;
    this.lens.water.value.set(
      fluid?.haze_per_mm ?? 0,
      fluid?.fog ?? 0,
      fluid?.smear ?? 0,
      fluid?.dry === true && !fluid.flushing ? 1 : 0,
    );
  }

  /** Before each picture. @param walls  places of the wall that is seen; undefined outside */
  lay(walls: ArrayLike<number> | undefined, view: BubbleView, nowMs: number): void {
    const { fluid } = this;
    const isWet = fluid !== null && (!fluid.dry || fluid.flushing);
    this.mesh.visible = isWet && walls !== undefined;
    if (!this.mesh.visible || walls === undefined || fluid === null) return;
    if (!this.isStill.matches) this.lens.drift.value = (nowMs / 1000) % 3600;
    if (nowMs - this.collectedMs >= COLLECTED_MS) {
      this.collectedMs = nowMs;
      this.collect(walls, view, Math.round(fluid.bubbles * MOST_BUBBLES));
    }
    const haze = Math.min(1, fluid.haze_per_mm / FLECKS_AT_HAZE);
    const flecks = Math.round(FEWEST_FLECKS + haze * (MOST_FLECKS - FEWEST_FLECKS));
    this.mesh.geometry.instanceCount = this.bubbles + flecks;
  }

  private collect(walls: ArrayLike<number>, view: BubbleView, most: number): void {
    const places = most === 0 ? [] : highestPlaces(walls, view, most);
    this.bubbles = places.length;
    places.forEach((at, i) => {
      // The first are the largest; none lies in the wall.
      const radius = 0.2 + 0.4 * scattered(i + 1) * (1 - i / (2 * MOST_BUBBLES));
      const to = new THREE.Vector3(...view.eyeMm).sub(new THREE.Vector3(...at)).setLength(radius);
      this.place.setXYZW(i, at[0] + to.x, at[1] + to.y, at[2] + to.z, radius);
      this.isBubble.setX(i, 1);
    });
    for (let i = this.bubbles; i < MOST; ++i) {
      const seed = MOST - i; // each fleck stays where it is whatever the bubbles do
      this.place.setXYZW(
        i,
        scattered(3 * seed),
        scattered(3 * seed + 1),
        scattered(3 * seed + 2),
        0.03 + 0.06 * scattered(seed + 200),
      );
      this.isBubble.setX(i, 0);
    }
    this.place.needsUpdate = this.isBubble.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}

/** 0 to 1, by the golden ratio: never two beside each other. */
function scattered(n: number): number {
  return (n * 0.6180339887) % 1;
}

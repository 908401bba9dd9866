// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth of field in the scope's picture. The joint is drawn aside, with its depth; what is out of focus is
// gathered at half the size and laid over it. What is in focus comes through bit by bit as it was drawn.
//   1  halved: four points to one, and how soft the nearest of them is
//   2  tiles: of 8 by 8 of those the softest that lies near
//   3  about: the same of the tiles beside each too, for what lies near spreads over what is sharp beside it
//   4  gathered: of the points about each one those whose disc reaches it, as far as the softest about reaches
//   5  laid over the sharp picture, by how soft each point is; then what is on the lens itself
import * as THREE from "three";
import { BEHIND_MM, focusPerMm, PUPIL_MM, SHARP_RAD, WELL_SET_STEP } from "./focus_model";
import type { LensUniforms } from "./scope_shader";

/** Of halved points a tile is so many across; no disc's radius is more: three tiles by three hold it. */
const TILE = 8;
const FEWEST_TAPS = 5;
const MOST_TAPS = 32;

const VERTEX = /* glsl */ `
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }`;

const HEAD = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
const float kMost = ${TILE}.0;
out vec4 shown;
// How soft, as the disc's radius in halved points, below 0 where it lies behind what is in focus; as it is kept.
float kept(float soft) { return (127.0 + 127.0 / kMost * soft) / 255.0; }
float softOf(float byte) { return (255.0 * byte - 127.0) * kMost / 127.0; }
`;

/** As focus_model.ts has it, from depths as the lens of scope_shader.ts lays them: 60 mm at the far end. */
const CIRCLE = /* glsl */ `
uniform sampler2D picture, depths;
uniform float focus, behind, pointsPerRad;
float offBy(float depth) { return 1.0 / (depth < 0.9999 ? max(60.0 * depth, 0.2) : behind) - focus; }
// Of the disc's radius.
float squared(float off) {
  return (${PUPIL_MM ** 2} * off * off - ${SHARP_RAD ** 2}) * 0.0625 * pointsPerRad * pointsPerRad;
}
float circle(float depth) {
  float off = offBy(depth);
  return sign(off) * min(kMost, sqrt(max(0.0, squared(off))));
}
`;

const HALVED = /* glsl */ `${HEAD}${CIRCLE}
void main() {
  ivec2 most = textureSize(depths, 0) - 1;
  ivec2 at = 2 * ivec2(gl_FragCoord.xy);
  vec3 light = vec3(0.0);
  float soft = -kMost;
  for (int i = 0; i < 4; ++i) {
    ivec2 one = min(at + ivec2(i & 1, i >> 1), most);
    // Squares: light adds up, not what a screen is told to show of it.
    vec3 colour = texelFetch(picture, one, 0).rgb;
    light += colour * colour;
    soft = max(soft, circle(texelFetch(depths, one, 0).r));
  }
  shown = vec4(sqrt(0.25 * light), kept(soft));
}`;

const TILES = /* glsl */ `${HEAD}
uniform sampler2D halved;
void main() {
  ivec2 most = textureSize(halved, 0) - 1;
  ivec2 at = ${TILE} * ivec2(gl_FragCoord.xy);
  float soft = 0.0;
  for (int y = 0; y < ${TILE}; ++y)
    for (int x = 0; x < ${TILE}; ++x)
      soft = max(soft, softOf(texelFetch(halved, min(at + ivec2(x, y), most), 0).a));
  shown = vec4(kept(soft));
}`;

const ABOUT = /* glsl */ `${HEAD}
uniform sampler2D tiles;
void main() {
  ivec2 most = textureSize(tiles, 0) - 1;
  ivec2 at = ivec2(gl_FragCoord.xy);
  shown = vec4(0.0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      shown = max(shown, texelFetch(tiles, clamp(at + ivec2(x, y), ivec2(0), most), 0));
}`;

const GATHERED = /* glsl */ `${HEAD}
uniform sampler2D halved, about;
const float kRim = 0.985; // beyond it the picture is darkened towards its edge, which is always sharp
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 here = texelFetch(halved, at, 0);
  float own = softOf(here.a);
  float reach = max(abs(own), softOf(texelFetch(about, at / ${TILE}, 0).r));
  shown = vec4(here.rgb, 0.0);
  vec2 perPoint = 1.0 / vec2(textureSize(halved, 0));
  vec2 from = 2.0 * perPoint * gl_FragCoord.xy - 1.0;
  if (reach < 0.2 || dot(from, from) > 1.05) return;
  float count = clamp(ceil(4.0 + reach * reach), ${FEWEST_TAPS}.0, ${MOST_TAPS}.0);
  int taps = int(count);
  // What is darkened at the rim counts for nothing beside what is not.
  float total = dot(from, from) < kRim * kRim ? 1.0 : 0.01;
  vec3 light = total * here.rgb * here.rgb;
  float near = 0.0;
  const mat2 kTurn = mat2(-0.73737, 0.67549, -0.67549, -0.73737); // by the golden angle
  vec2 way = vec2(1.0, 0.0);
  for (int i = 0; i < taps; ++i) {
    float away = reach * sqrt((float(i) + 0.5) / count);
    way = kTurn * way;
    vec2 place = (gl_FragCoord.xy + away * way) * perPoint;
    vec2 out_by = 2.0 * place - 1.0;
    if (dot(out_by, out_by) > kRim * kRim) continue;
    vec4 one = texture(halved, place);
    float soft = softOf(one.a);
    // What lies behind shows here no wider than this point itself is spread.
    float radius = soft < own ? min(abs(soft), abs(own)) : abs(soft);
    float reaches = clamp(radius - away + 0.75, 0.0, 1.0) * step(0.2, radius);
    light += mix(light / total, one.rgb * one.rgb, reaches);
    total += 1.0;
    if (soft > 0.2) near += reaches;
  }
  shown = vec4(sqrt(light / total), min(2.0 * near / count, 1.0));
}`;

const LAID = /* glsl */ `${HEAD}${CIRCLE}
uniform sampler2D gathered;
uniform float perPoint;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  shown = vec4(texelFetch(picture, at, 0).rgb, 1.0);
  vec2 place = gl_FragCoord.xy * perPoint;
  vec2 from = 2.0 * place - 1.0;
  float r2 = dot(from, from);
  if (r2 >= 1.0) return;
  vec4 soft = texture(gathered, place);
  float own = squared(offBy(texelFetch(depths, at, 0).r));
  float share = max(soft.a, clamp(2.2 * own - 0.1, 0.0, 1.0));
  // The rim as the shaders darken it.
  if (r2 > 0.97) soft.rgb *= pow(1.0 - smoothstep(0.985, 1.0, sqrt(r2)), 1.0 / 2.2);
  shown.rgb = mix(shown.rgb, soft.rgb, share);
}`;

export interface FocusedView {
  readonly scene: THREE.Scene;
  readonly camera: THREE.Camera;
  readonly sizePx: number;
  /** What is drawn where there is no depth is so far away; undefined: as inside the joint [mm]. */
  readonly behindMm: number | undefined;
}

export class ScopeFocus {
  /** Of the ring. */
  step = WELL_SET_STEP;
  private readonly drawn = target(THREE.NearestFilter);
  private readonly half = target(THREE.LinearFilter);
  private readonly tile = target(THREE.NearestFilter);
  private readonly spread = target(THREE.NearestFilter);
  private readonly soft = target(THREE.LinearFilter);
  private readonly triangle = new THREE.BufferGeometry();
  private readonly focus = { value: 0 };
  private readonly behind = { value: BEHIND_MM };
  private readonly pointsPerRad = { value: 0 };
  private readonly perPoint = { value: 0 };
  private readonly passes: readonly {
    readonly scene: THREE.Scene;
    readonly material: THREE.ShaderMaterial;
    readonly into: THREE.WebGLRenderTarget | null;
  }[];

  /** @param over  lies on the lens: always as sharp as it is */
  constructor(
    private readonly lens: LensUniforms,
    over: THREE.Object3D,
  ) {
    this.triangle.setAttribute(
      "position",
      new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3),
    );
    const depth = new THREE.DepthTexture(1, 1, THREE.UnsignedIntType);
    this.drawn.depthBuffer = true;
    this.drawn.depthTexture = depth;
    const circle = {
      picture: { value: this.drawn.texture },
      depths: { value: depth },
      focus: this.focus,
      behind: this.behind,
      pointsPerRad: this.pointsPerRad,
    };
    const halved = { value: this.half.texture };
    const tiles = { value: this.tile.texture };
    const about = { value: this.spread.texture };
    const gathered = { value: this.soft.texture };
    this.passes = [
      this.pass(HALVED, circle, this.half),
      this.pass(TILES, { halved }, this.tile),
      this.pass(ABOUT, { tiles }, this.spread),
      this.pass(GATHERED, { halved, about }, this.soft),
      this.pass(LAID, { ...circle, gathered, perPoint: this.perPoint }, null),
    ];
    this.passes.at(-1)?.scene.add(over);
  }

  private pass(
    fragmentShader: string,
    uniforms: Record<string, THREE.IUniform>,
    into: THREE.WebGLRenderTarget | null,
  ): ScopeFocus["passes"][number] {
    const material = new THREE.ShaderMaterial({
      name: "scope focus",
      glslVersion: THREE.GLSL3,
      uniforms,
      vertexShader: VERTEX,
      fragmentShader,
      depthTest: false,
      depthWrite: false,
    });
    const mesh = new THREE.Mesh(this.triangle, material);
    mesh.frustumCulled = false;
    const scene = new THREE.Scene();
    scene.add(mesh);
    return { scene, material, into };
  }

  draw(renderer: THREE.WebGLRenderer, { scene, camera, sizePx, behindMm }: FocusedView): void {
    const half = Math.ceil(sizePx / 2);
    this.drawn.setSize(sizePx, sizePx);
    this.half.setSize(half, half);
    this.soft.setSize(half, half);
    const tiles = Math.ceil(half / TILE);
    this.tile.setSize(tiles, tiles);
    this.spread.setSize(tiles, tiles);
    this.focus.value = focusPerMm(this.step);
    this.behind.value = behindMm ?? BEHIND_MM;
    this.perPoint.value = 1 / sizePx;
    this.pointsPerRad.value = sizePx / (2 * this.lens.halfField.value);
    renderer.setRenderTarget(this.drawn);
    renderer.autoClear = true;
    renderer.render(scene, camera);
    renderer.autoClear = false; // each pass covers all
    for (const pass of this.passes) {
      renderer.setRenderTarget(pass.into);
      renderer.render(pass.scene, camera);
    }
  }

  dispose(): void {
    for (const one of [this.drawn, this.half, this.tile, this.spread, this.soft]) one.dispose();
    this.drawn.depthTexture?.dispose();
    for (const { material } of this.passes) material.dispose();
    this.triangle.dispose();
  }
}

function target(filter: THREE.MagnificationTextureFilter): THREE.WebGLRenderTarget {
  return new THREE.WebGLRenderTarget(1, 1, {
    magFilter: filter,
    minFilter: filter as THREE.MinificationTextureFilter,
    generateMipmaps: false,
    depthBuffer: false,
  });
}

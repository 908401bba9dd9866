// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How bone, skin and steel look. Colours: docs/ui.md's tokens.
import * as THREE from "three";
import { hexOf, materialOf, roughnessOf } from "../appearance";
import { BLEND_DECLARATIONS } from "./blend_shader";
import { CREASES_GLSL } from "./skin_creases";
import type { StructureKind } from "./structure_model";
import { CUT_GLSL, TRACKS_GLSL, type TrackUniforms } from "./track_shader";

export const BONE_COLOR = hexOf(materialOf("bone").diffuse);
export const SKIN_COLOR = hexOf(materialOf("skin").diffuse);
export const ACCENT_COLOR = "#5cc8ff";
export const ATTENTION_COLOR = "#f0c36a";

/** Value noise in the bone's own mm, three octaves: bone is not one even colour or gloss. */
export const NOISE_GLSL = /* glsl */ `
float hash3(vec3 p) {
  p = fract(p * vec3(0.1031, 0.1030, 0.0973));
  p += dot(p, p.yxz + 33.33);
  return fract((p.x + p.y) * p.z);
}
float noise3(vec3 x) {
  vec3 i = floor(x);
  vec3 f = fract(x);
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(mix(hash3(i), hash3(i + vec3(1, 0, 0)), f.x),
                 mix(hash3(i + vec3(0, 1, 0)), hash3(i + vec3(1, 1, 0)), f.x), f.y),
             mix(mix(hash3(i + vec3(0, 0, 1)), hash3(i + vec3(1, 0, 1)), f.x),
                 mix(hash3(i + vec3(0, 1, 1)), hash3(i + vec3(1, 1, 1)), f.x), f.y), f.z);
}
`;

/** Matt bone; `color` attribute carries the occlusion. Its look is applied_look.ts's to change. */
export function boneMaterial(): THREE.MeshPhysicalMaterial {
  const bone = materialOf("bone");
  const material = new THREE.MeshPhysicalMaterial({
    color: BONE_COLOR,
    roughness: roughnessOf(bone),
    metalness: 0,
    vertexColors: true,
    envMapIntensity: bone.ambient,
  });
  material.onBeforeCompile = grain;
  return material;
}

type Shader = THREE.WebGLProgramParametersWithUniforms;

/** Gives the fragment its place in the bone's own mm. */
function place(shader: Shader, declarations: string): void {
  shader.vertexShader = shader.vertexShader
    .replace("#include <common>", "#include <common>\nvarying vec3 vBoneMm;")
    .replace("#include <begin_vertex>", "#include <begin_vertex>\nvBoneMm = position;");
  shader.fragmentShader = shader.fragmentShader.replace(
    "#include <common>",
    `#include <common>\nvarying vec3 vBoneMm;\n${NOISE_GLSL}\n${declarations}`,
  );
}

function grain(shader: Shader): void {
  place(shader, "");
  shader.fragmentShader = shader.fragmentShader
    .replace(
      "#include <color_fragment>",
      `#include <color_fragment>
float boneGrain = 0.6 * noise3(vBoneMm * 0.45) + 0.3 * noise3(vBoneMm * 1.7) + 0.1 * noise3(vBoneMm * 5.0);
#ifndef USE_MAP
diffuseColor.rgb *= mix(vec3(0.90, 0.86, 0.80), vec3(1.04, 1.03, 1.02), boneGrain);
#endif`,
    )
    .replace(
      "#include <roughnessmap_fragment>",
      "#include <roughnessmap_fragment>\nroughnessFactor = clamp(roughnessFactor + 0.22 * (boneGrain - 0.5), 0.4, 1.0);",
    );
}

/** The bone's surface is left out where it was drilled away; at the rim the fresh cut is seen. */
function cut(shader: Shader): void {
  shader.fragmentShader = shader.fragmentShader
    .replace("varying vec3 vBoneMm;", `varying vec3 vBoneMm;\n${TRACKS_GLSL}`)
    .replace("void main() {", `void main() {\n${CUT_GLSL}`)
    .replace(
      "#include <opaque_fragment>",
      `outgoingLight *= mix(0.62, 1.0, boneEdge) * mix(0.86, 1.0, smoothstep(0.0, 0.14, boneAway));
#include <opaque_fragment>`,
    );
}

/** Makes a bone's material, matt or glass, leave out what was drilled away. */
export function withTracks(material: THREE.Material, tracks: TrackUniforms): void {
  const before = material.onBeforeCompile.bind(material);
  const key = `${material.type} with tracks`;
  material.onBeforeCompile = (shader, renderer) => {
    before(shader, renderer);
    Object.assign(shader.uniforms, tracks);
    cut(shader);
  };
  material.customProgramCacheKey = () => key;
  material.needsUpdate = true;
}

/** A wall stays where it is its own track's; this far within another it is gone [mm]. */
const WALL_WITHIN_MM = 0.02;

/** Freshly drilled bone: a hard pale rim, porous and redder within, darker the deeper. */
export function tunnelMaterial(tracks: TrackUniforms): THREE.MeshStandardMaterial {
  const material = new THREE.MeshStandardMaterial({
    color: "#ffffff",
    roughness: 0.9,
    metalness: 0,
    envMapIntensity: 0.25,
  });
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, tracks);
    place(shader, `varying vec2 vDepths;\n${TRACKS_GLSL}`);
    shader.vertexShader = shader.vertexShader
      .replace(
        "#include <common>",
        "#include <common>\nattribute vec2 depths;\nvarying vec2 vDepths;",
      )
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvDepths = depths;");
    shader.fragmentShader = shader.fragmentShader
      .replace(
        "void main() {",
        `void main() {\nif (outsideTracks(vBoneMm) < -${WALL_WITHIN_MM.toFixed(3)}) discard;`,
      )
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
float pore = 0.6 * noise3(vBoneMm * 3.4) + 0.4 * noise3(vBoneMm * 8.3);
vec3 cortex = vec3(0.60, 0.52, 0.39) * (0.94 + 0.12 * pore);
vec3 spongy = mix(vec3(0.30, 0.15, 0.095), vec3(0.56, 0.42, 0.29), smoothstep(0.25, 0.66, pore));
float within = smoothstep(0.6, 1.5, vDepths.y + 0.5 * (pore - 0.5));
diffuseColor.rgb = mix(cortex, spongy, within) * mix(0.14, 1.0, vDepths.x);`,
      );
  };
  return material;
}

const SHELL_VERTEX = /* glsl */ `
varying vec3 vNormalView;
varying vec3 vToEye;
varying vec3 vBoneMm;
void main() {
  vBoneMm = position;
  vec4 inView = modelViewMatrix * vec4(position, 1.0);
  vNormalView = normalMatrix * normal;
  vToEye = -inView.xyz;
  gl_Position = projectionMatrix * inView;
}
`;

const SHELL_FRAGMENT = /* glsl */ `
uniform vec3 tint;
uniform float opacity;
uniform float rim;
varying vec3 vNormalView;
varying vec3 vToEye;
varying vec3 vBoneMm;
void main() {
  vec3 n = normalize(vNormalView);
  float facing = abs(dot(n, normalize(vToEye)));
  float edge = pow(1.0 - facing, 2.2);
  float light = 0.55 + 0.45 * max(0.0, dot(n, normalize(vec3(-0.4, 0.7, 0.6))));
  float alpha = clamp(opacity * (0.34 + rim * edge), 0.0, 1.0);
  gl_FragColor = vec4(tint * light * (0.85 + 0.5 * edge), mix(alpha, 1.0, smoothstep(0.9, 1.0, opacity)));
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
}
`;

function shell(
  vertexShader: string,
  color: string,
  opacity: number,
  rim: number,
): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    vertexShader,
    fragmentShader: SHELL_FRAGMENT,
    uniforms: {
      tint: { value: new THREE.Color(color) },
      opacity: { value: opacity },
      rim: { value: rim },
    },
    transparent: true,
    depthWrite: false,
    depthFunc: THREE.LessEqualDepth,
  });
}

/** The skin as a clean shell: clear where one looks straight at it, dense at its edge. */
export function skinMaterial(vertexShader: string): THREE.ShaderMaterial {
  return shell(vertexShader, SKIN_COLOR, 0.2, 2.6);
}

const CLOSED_SKIN_FRAGMENT = /* glsl */ `
uniform vec3 tint;
uniform float cuff;
varying float vFromRim;
varying vec3 vNormalView;
varying vec3 vToEye;
varying vec3 vBoneMm;
varying vec3 vOut;
${CREASES_GLSL}
float hash(vec3 p) {
  return fract(sin(dot(p, vec3(12.9898, 78.233, 37.719))) * 43758.5453);
}
float mottle(vec3 p) {
  vec3 i = floor(p);
  vec3 f = smoothstep(0.0, 1.0, fract(p));
  vec4 low = vec4(hash(i), hash(i + vec3(1, 0, 0)), hash(i + vec3(0, 1, 0)), hash(i + vec3(1, 1, 0)));
  i.z += 1.0;
  vec4 high = vec4(hash(i), hash(i + vec3(1, 0, 0)), hash(i + vec3(0, 1, 0)), hash(i + vec3(1, 1, 0)));
  vec4 level = mix(low, high, f.z);
  return mix(mix(level.x, level.y, f.x), mix(level.z, level.w, f.x), f.y);
}
void main() {
  vec3 n = normalize(vNormalView);
  vec3 eye = normalize(vToEye);
  float patches = mottle(vBoneMm * 0.22);
  float pores = mottle(vBoneMm * 2.1);
  n = normalize(n + 0.07 * (vec3(pores, mottle(vBoneMm * 2.1 + 17.0), mottle(vBoneMm * 2.1 + 41.0)) - 0.5));
  vec3 key = normalize(vec3(-0.4, 0.75, 0.55));
  float facing = dot(n, key);
  // Light goes some way through skin: the edge of the shade is soft and red.
  float lit = smoothstep(-0.45, 1.0, facing);
  vec3 through = vec3(0.30, 0.05, 0.02) * smoothstep(-0.5, 0.1, facing) * (1.0 - smoothstep(0.1, 0.6, facing));
  float fill = 0.22 + 0.1 * n.y;
  float shine = 0.10 * pow(max(0.0, dot(reflect(-key, n), eye)), 18.0);
  vec3 skin = tint * mix(vec3(1.0, 0.86, 0.82), vec3(1.03, 1.0, 0.97), patches) * (0.94 + 0.1 * pores);
  skin *= mix(vec3(1.0), vec3(0.55, 0.3, 0.25), creases(vBoneMm, vOut, patches));
  vec3 color = skin * (fill + 0.85 * lit) + 0.5 * tint * through + shine;
  float edge = pow(1.0 - max(0.0, dot(n, eye)), 3.0);
  color *= 1.0 - 0.25 * edge;
  // Where the scan ends the limb is draped: a cuff of cloth with folds.
  float folds = 0.5 + 0.5 * sin(1.3 * (vBoneMm.x + vBoneMm.y + 0.6 * vBoneMm.z) + 3.0 * patches);
  vec3 cloth = vec3(0.055, 0.19, 0.20) * (0.35 + 0.75 * lit) * mix(0.72, 1.08, folds);
  float hem = cuff + 1.2 * patches;
  color = mix(cloth, color * smoothstep(hem - 0.2, hem + 2.5, vFromRim + 0.9), smoothstep(hem - 0.35, hem, vFromRim));
  gl_FragColor = vec4(color, 1.0);
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
}
`;

/** Skin that nothing is seen through, draped where it ends. @param cuffMm  width of the cloth */
export function closedSkinMaterial(vertexShader: string, cuffMm: number): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    vertexShader,
    fragmentShader: CLOSED_SKIN_FRAGMENT,
    uniforms: { tint: { value: new THREE.Color(SKIN_COLOR) }, cuff: { value: cuffMm } },
    side: THREE.DoubleSide,
  });
}

/** Bone that one looks into, for the placement in the score. */
export function glassBoneMaterial(color: string = BONE_COLOR): THREE.ShaderMaterial {
  return shell(SHELL_VERTEX, color, 0.42, 1.9);
}

/** Only depth, so that of a see-through shell the nearest face alone is drawn. */
export function depthOnlyMaterial(vertexShader: string): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    vertexShader,
    fragmentShader: "void main() { gl_FragColor = vec4(1.0); }",
    colorWrite: false,
  });
}

function metalMaterial(color: string, roughness: number): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({ color, roughness, metalness: 1, envMapIntensity: 1.6 });
}

export function steelMaterial(): THREE.MeshStandardMaterial {
  return metalMaterial("#c9d0d4", 0.24);
}

export function titaniumMaterial(): THREE.MeshStandardMaterial {
  return metalMaterial("#9fb3c4", 0.3);
}

export function handleMaterial(): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({
    color: "#39444a",
    roughness: 0.5,
    metalness: 0.35,
    envMapIntensity: 0.6,
  });
}

/** Blackened parts: knobs, cables, the inside of a barrel. */
export function blackMaterial(): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({ color: "#14181a", roughness: 0.6, metalness: 0.1 });
}

/** A gloved finger: seen from behind it hides what lies under it less than a finger would. */
export function gloveMaterial(): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({
    color: "#9fc0d8",
    roughness: 0.55,
    envMapIntensity: 0.5,
    transparent: true,
    opacity: 0.5,
  });
}

export type BlendUniforms = Readonly<
  Record<"forearmReal" | "forearmDual" | "handReal" | "handDual", { value: THREE.Vector4 }>
>;

/** A tube that bends with the wrist (structures.ts): moist, a little brighter than bone. */
export function structureMaterial(
  kind: StructureKind,
  motion: BlendUniforms,
): THREE.MeshPhysicalMaterial {
  const look = materialOf(kind);
  const material = new THREE.MeshPhysicalMaterial({
    color: hexOf(look.diffuse),
    roughness: roughnessOf(look),
    metalness: 0,
    envMapIntensity: look.ambient,
  });
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, motion);
    shader.vertexShader = shader.vertexShader
      .replace(
        "#include <common>",
        `#include <common>\nattribute float _hand_share;\n${BLEND_DECLARATIONS}`,
      )
      .replace(
        "#include <beginnormal_vertex>",
        "blendBegin(_hand_share);\nvec3 objectNormal = blendTurned(normal);",
      )
      .replace("#include <begin_vertex>", "vec3 transformed = blendMoved(position);");
  };
  return material;
}

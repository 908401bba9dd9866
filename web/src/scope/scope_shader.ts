// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The scope's picture of what is wet: an equidistant lens in the vertex shader (equal angles are equally
// long, as arthroscopy/optics.hpp has it), light that comes from beside the lens and falls off, and
// what lines the joint told apart by colour, gloss and grain, all procedural.
import * as THREE from "three";
import { FLUID_GLSL } from "./fluid_shader";
import { NOISE_GLSL } from "./noise_shader";
import { HOLE_GLSL, holeUniforms, type HoleUniforms } from "./screw_hole";
import { LESIONS_GLSL, lesionUniforms, type LesionUniforms } from "./scope_lesions";

/** How bright the lamp is: a disc 12 mm away is still well exposed. */
export const LAMP = "46.0";

export interface LensUniforms {
  readonly eye: THREE.IUniform<THREE.Vector3>;
  readonly axis: THREE.IUniform<THREE.Vector3>;
  readonly up: THREE.IUniform<THREE.Vector3>;
  readonly right: THREE.IUniform<THREE.Vector3>;
  readonly lamp: THREE.IUniform<THREE.Vector3>;
  readonly halfField: THREE.IUniform<number>;
  readonly exposure: THREE.IUniform<number>;
  /** As fluid_shader.ts has it. */
  readonly water: THREE.IUniform<THREE.Vector4>;
  readonly drift: THREE.IUniform<number>;
  readonly [name: string]: THREE.IUniform;
}

export function lensUniforms(): LensUniforms {
  const v = (): THREE.IUniform<THREE.Vector3> => ({ value: new THREE.Vector3() });
  return {
    eye: v(),
    axis: v(),
    up: v(),
    right: v(),
    lamp: v(),
    halfField: { value: 0.7 },
    exposure: { value: 1 },
    water: { value: new THREE.Vector4() },
    drift: { value: 0 },
  };
}

const VERTEX = /* glsl */ `
uniform vec3 eye, axis, up, right;
uniform float halfField;
attribute vec4 lining;
attribute vec3 fibre;
attribute vec3 rest;
attribute float gone;
attribute float share;
varying float vGone;
varying float vShare;
varying vec3 vAt;
varying vec3 vNormal;
varying vec4 vLining;
varying vec3 vFibre;
varying vec3 vScreen;
varying vec3 vRest;
invariant gl_Position; // for depths that must be equal
void main() {
  vRest = rest;
  vShare = share;
  vGone = gone;
  mat4 place = modelMatrix;
#ifdef USE_INSTANCING
  place = modelMatrix * instanceMatrix;
#endif
  vec3 at = (place * vec4(position, 1.0)).xyz;
  vec3 to = at - eye;
  vec3 seen = vec3(dot(to, right), dot(to, up), dot(to, axis));
  float aside = length(seen.xy);
  float angle = atan(aside, seen.z);
  vec2 round = aside > 1e-6 ? seen.xy / aside * (angle / halfField) : vec2(0.0);
  float far = length(to);
  gl_Position = vec4(round * far, (2.0 * far / 60.0 - 1.0) * far, far);
  vScreen = vec3(round * far, far);
  vAt = at;
  vNormal = mat3(place) * normal;
  vLining = lining;
  vFibre = fibre;
}`;

// Neither beyond the round field, nor where a facet goes round behind the lens: that would be drawn right across what is before it.
const IN_FIELD = `r <= 1.0 && dot(to, axis) >= 0.2 * length(to)`;

const DEPTH_FRAGMENT = /* glsl */ `
precision highp float;
uniform vec3 eye, axis;
varying vec3 vAt;
varying vec3 vScreen;
void main() {
  vec3 to = vAt - eye;
  float r = length(vScreen.xy / vScreen.z);
  if (!(${IN_FIELD})) discard;
}`;

const FRAGMENT = /* glsl */ `
precision highp float;
uniform vec3 eye, axis, lamp;
uniform float isMetal, exposure;
uniform vec4 shines;
varying vec3 vAt;
varying vec3 vNormal;
varying vec4 vLining;
varying vec3 vFibre;
varying vec3 vScreen;
varying float vGone;

${NOISE_GLSL}float power5(float x) { return x * x * x * x * x; }
float power28(float x) {
  float x4 = x * x * x * x, x8 = x4 * x4;
  return x4 * x8 * x8 * x8;
}
// A hard glare; on villi it is broken up and wider: as sharp as on cartilage it would flicker from point to point.
float glare(float x, float villous) {
  float x28 = power28(x), x56 = x28 * x28, x112 = x56 * x56;
  return mix(x28 * x56 * x112 * x112 * x112, 0.5 * x112, villous);
}
const mat3 ASLANT = mat3(0.36, 0.48, -0.80, -0.80, 0.60, 0.0, 0.48, 0.64, 0.60);
float cloudy(vec3 p) { return 0.65 * noise(p) + 0.35 * noise(2.3 * p + 7.1); }
${LESIONS_GLSL}
${FLUID_GLSL}
${HOLE_GLSL}
void main() {
  vec3 to = vAt - eye;
  float far = length(to);
  vec3 view = -to / far;
  // By the place on the screen: within a large triangle the true direction lies a chord beside it.
  float r = length(vScreen.xy / vScreen.z);
#ifndef DEPTH_IS_LAID
  if (!(${IN_FIELD})) discard;
#endif
  // Into the joint, by which side it is: asked of the view it would flip along every edge, as dots.
  vec3 n = normalize(vNormal) * (isMetal > 0.5 ? 1.0 : -1.0);
  vec3 smooth_n = n;

  float soft = cloudy(vAt * 0.9);
  float grain = noise(ASLANT * vAt * 6.0);
  // What lines it, sharpened: edges are some tenths of a millimetre wide, and ragged.
  vec4 w = vLining + (soft - 0.5) * 0.16 * step(0.02, vLining) ;
  w = smoothstep(0.22, 0.78, w) * (1.0 - isMetal);
  float known = clamp(w.x + w.y + w.z + w.w, 0.0, 1.0);
  float red = 1.0 - known;

  vec3 cartilage = mix(vec3(0.80, 0.83, 0.82), vec3(0.93, 0.90, 0.83), soft);
  vec3 disc = vec3(0.80, 0.72, 0.56);
  for (int i = ifAny(w.y); i > 0; --i) disc = mix(disc, vec3(0.93, 0.88, 0.76), cloudy(vAt * 1.7));
  vec3 bone = mix(vec3(0.80, 0.68, 0.50), vec3(0.86, 0.76, 0.60), soft);
  // Bundles of fibres: long along a ligament's strands, narrow across; they lie in the tissue and go with it.
  vec2 weave = vFibre.xy + 0.35 * (soft - 0.5);
  float bundle = 0.5;
  for (int i = ifAny(w.z); i > 0; --i)
    bundle = 0.6 * noise(vec3(2.6 * weave.x, 0.25 * weave.y, 0.5)) +
      0.4 * noise(vec3(5.2 * weave.x, 0.4 * weave.y, 3.7));
  // None between two ligaments, nor where they are crowded, nor finer than the picture's points.
  vec2 pace = fwidth(vAt.xy) + fwidth(vAt.yz);
  float crowded = length(fwidth(vFibre.xy)) / max(length(pace), 1e-6);
  bundle = mix(bundle, 0.5, max(smoothstep(1.5, 3.0, crowded), smoothstep(0.05, 0.18, length(pace))));
  bundle = mix(0.5, bundle, smoothstep(0.0, 0.8, vFibre.z));
  vec3 ligament = mix(vec3(0.70, 0.56, 0.43), vec3(0.94, 0.88, 0.78), smoothstep(0.2, 0.75, bundle));
  // Synovium with its vessels: thin ridges of noise.
  float vessel = 0.0;
  for (int i = ifAny(red); i > 0; --i) {
    float ridge = 1.0 - abs(2.0 * noise(vAt * 1.5 + 2.0 * soft) - 1.0);
    float twig = 1.0 - abs(2.0 * noise(vAt * 2.9 + 11.0) - 1.0);
    vessel = 0.8 * smoothstep(0.955, 0.998, ridge) + 0.5 * smoothstep(0.94, 0.995, twig);
  }
  // Its grid aslant and bent: straight, it would be seen in the glints.
  float villi = noise(ASLANT * vAt * 3.4 + 1.6 * (soft - 0.5));
  vec3 synovium = mix(vec3(0.66, 0.25, 0.19), vec3(0.90, 0.62, 0.50), 0.55 * soft + 0.45 * villi);
  synovium = mix(synovium, vec3(0.50, 0.04, 0.04), 0.6 * clamp(vessel, 0.0, 1.0));

  vec3 albedo = synovium * red;
  float total = red;
  albedo += cartilage * w.x; total += w.x;
  albedo += disc * w.y; total += w.y;
  albedo += ligament * w.z; total += w.z;
  albedo += bone * w.w; total += w.w;
  albedo /= max(total, 1e-3);
  float rough = (0.36 * red + 0.20 * w.x + 0.27 * w.y + 0.40 * w.z + 0.34 * w.w) / max(total, 1e-3);
  // What is finer than the picture's points is left out: it would sparkle as dots.
  float pointMm = length(fwidth(vAt));
  float fine = 1.0 - smoothstep(0.03, 0.12, pointMm);
  // Relief: shallow bumps of synovium and fibres tilt the normal.
  float relief = red * 0.55 * (villi - 0.5) + w.z * 0.28 * (bundle - 0.5);
  relief *= fine * (1.0 - isMetal);
  vec3 dx = dFdx(vAt), dy = dFdy(vAt);
  float hx = dFdx(relief), hy = dFdy(relief);
  vec3 r1 = cross(dy, n), r2 = cross(n, dx);
  float det = dot(dx, r1);
  vec3 bent = abs(det) * n - sign(det) * (hx * r1 + hy * r2) * 0.35;
  n = length(bent) > 1e-9 ? normalize(bent) : n;
  // Of metal only what lies deep in it is dark.
  albedo = mix(albedo, vec3(0.62, 0.64, 0.66) * (1.0 - 0.85 * vLining.w), isMetal);
  rough = mix(rough, 0.16, isMetal);
  float wet = 1.0;
  paintLesions(albedo, rough, wet);
  // Where a shaver took the disc away: its cut edge, and beneath it the cartilage of the ulna's head.
  float cut = vGone;
  for (int i = ifAny(vGone - 0.01); i > 0; --i) cut += 0.30 * (noise(vRest * 4.0) - 0.5);
  float edge = smoothstep(0.14, 0.30, cut) * (1.0 - smoothstep(0.55, 0.75, cut));
  float under = smoothstep(0.55, 0.75, cut);
  albedo = mix(albedo, mix(vec3(0.95, 0.90, 0.76), vec3(0.98, 0.97, 0.92), grain), edge);
  albedo = mix(albedo, vec3(0.80, 0.82, 0.80), under);
  wet = mix(wet, 1.0, max(edge, under));
  // Without fluid a thin film is left: duller, its glints fewer.
  wet *= 1.0 - 0.62 * water.w;
  rough += 0.10 * water.w * (1.0 - isMetal);
#ifdef HAS_SCREW
  cutByScrew(smooth_n, albedo, rough);
#endif

  vec3 away = lamp - vAt;
  float d2 = dot(away, away);
  vec3 l = away * inversesqrt(d2);
  float cone = mix(0.15, 1.0, smoothstep(0.55, 0.95, dot(-l, axis)));
  float e = ${LAMP} * (cone / (d2 + 11.0) + 0.0032);
  float wrap = mix(0.45, 0.0, isMetal);
  float nl = dot(n, l);
  float lit = max(0.0, (nl + wrap) / (1.0 + wrap));
  lit *= lit;
  vec3 tint = mix(vec3(1.0, 0.8, 0.68), vec3(1.0, 0.5, 0.36), red);
  tint = mix(tint, vec3(0.9, 0.95, 1.0), isMetal); // steel is not red
  vec3 colour = albedo * (e * lit + tint * (0.30 * e + 0.03));
  // Wet: a sharp highlight, a sheen about it, and a brighter rim.
  vec3 h = normalize(l + view);
  float nh = max(dot(n, h), 0.0);
  float a2 = rough * rough * rough * rough;
  float denominator = nh * nh * (a2 - 1.0) + 1.0;
  float ggx = a2 / (3.14159 * denominator * denominator);
  float fresnel = 0.03 + 0.97 * power5(1.0 - clamp(dot(n, view), 0.18, 1.0));
  colour += e * step(0.0, nl) * wet * (min(ggx * (0.03 + 0.5 * isMetal), 2.2) * 0.5 + 0.10 * power28(nh));
  colour += 0.3 * e * isMetal * (1.0 - vLining.w) * power5(nh);
  // A film of fluid over all of it, uneven: a small hard glare.
  vec3 film = normalize(mix(smooth_n, n, 0.25) + 0.05 * (vec3(soft, villi, grain) - 0.5));
  float coat = glare(max(dot(film, h), 0.0), red);
  // The fibres end in two crescents beside the lens: each has its glint.
  vec3 h2 = normalize(normalize(2.0 * eye - lamp - vAt) + view);
  coat += 0.7 * glare(max(dot(film, h2), 0.0), red);
  colour += (1.0 - isMetal) * e * step(0.0, nl) * 2.4 * coat * wet;
  colour += 0.16 * e * fresnel * wet * vec3(0.93, 0.98, 1.05);
  // A mark shines by itself, whatever the lamp does.
  colour = mix(colour, shines.rgb * (0.35 + 0.65 * max(dot(smooth_n, view), 0.0)) / exposure, 0.85 * shines.a);
  // Water between.
  colour = mix(colour, vec3(0.10, 0.055, 0.04), (1.0 - water.w) * (1.0 - exp(-0.022 * max(0.0, far - 3.0))));
  colour = throughBlood(colour, vAt);
  // The camera: its exposure, darker at the rim, filmic, a little noise in the dark.
  colour *= exposure * (1.0 - 0.45 * r * r * r * sqrt(r));
  colour = clamp((colour * (2.51 * colour + 0.03)) / (colour * (2.43 * colour + 0.59) + 0.14), 0.0, 1.0);
  float grey = dot(colour, vec3(0.3, 0.59, 0.11));
  colour = mix(vec3(grey), colour, 1.22);
  colour += wet * (grain - 0.5) * mix(0.014, 0.006, grey); // none in a hole, where it would show as blotches
  colour *= 1.0 - smoothstep(0.985, 1.0, r);
  gl_FragColor = vec4(pow(max(colour, 0.0), vec3(1.0 / 2.2)), 1.0);
}`;

export function wetMaterial(
  lens: LensUniforms,
  isMetal: boolean,
  lesions: LesionUniforms = lesionUniforms(),
  hole: HoleUniforms = holeUniforms(),
): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    name: isMetal ? "scope metal" : "scope tissue",
    uniforms: {
      ...lens,
      ...lesions,
      ...hole,
      isMetal: { value: isMetal ? 1 : 0 },
      shines: { value: new THREE.Vector4() },
    },
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    // The wall is closed and seen from within alone.
    side: isMetal ? THREE.DoubleSide : THREE.BackSide,
  });
}

/**
 * Draws the wall's depth alone, before all else: what it hides of itself, and what lies outside of the field, is then not
 * shaded. Shading is dear and depth is cheap.
 */
export function depthMaterial(lens: LensUniforms): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    name: "scope depth",
    uniforms: lens,
    vertexShader: VERTEX,
    fragmentShader: DEPTH_FRAGMENT,
    side: THREE.BackSide,
    colorWrite: false,
  });
}

/**
 * How a wall is shaded. @param hasScrew  one may have gone through it: what has none saves its cost
 * @param isDepthLaid  by depthMaterial, before
 */
export function setWall(
  material: THREE.ShaderMaterial,
  hasScrew: boolean,
  isDepthLaid: boolean,
): void {
  material.defines = {
    ...(hasScrew ? { HAS_SCREW: "" } : {}),
    ...(isDepthLaid ? { DEPTH_IS_LAID: "" } : {}),
  };
  material.depthFunc = isDepthLaid ? THREE.EqualDepth : THREE.LessEqualDepth;
  material.depthWrite = !isDepthLaid;
  material.needsUpdate = true;
}

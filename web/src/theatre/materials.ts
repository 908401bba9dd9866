// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How bone, skin and steel look. Colours: docs/ui.md's tokens.
import * as THREE from "three";

export const BONE_COLOR = "#e9dfc7";
export const SKIN_COLOR = "#c99a80";
export const ACCENT_COLOR = "#5cc8ff";
export const ATTENTION_COLOR = "#f0c36a";

/** Value noise in the bone's own mm, three octaves: bone is not one even colour or gloss. */
const NOISE_GLSL = /* glsl */ `
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

/** Matt bone; `color` attribute carries the occlusion. */
export function boneMaterial(): THREE.MeshStandardMaterial {
  const material = new THREE.MeshStandardMaterial({
    color: BONE_COLOR,
    roughness: 0.72,
    metalness: 0,
    vertexColors: true,
    envMapIntensity: 0.3,
  });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vBoneMm;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvBoneMm = position;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", `#include <common>\nvarying vec3 vBoneMm;\n${NOISE_GLSL}`)
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
float boneGrain = 0.6 * noise3(vBoneMm * 0.45) + 0.3 * noise3(vBoneMm * 1.7) + 0.1 * noise3(vBoneMm * 5.0);
diffuseColor.rgb *= mix(vec3(0.90, 0.86, 0.80), vec3(1.04, 1.03, 1.02), boneGrain);`,
      )
      .replace(
        "#include <roughnessmap_fragment>",
        "#include <roughnessmap_fragment>\nroughnessFactor = clamp(roughnessFactor + 0.22 * (boneGrain - 0.5), 0.4, 1.0);",
      );
  };
  return material;
}

const SHELL_VERTEX = /* glsl */ `
varying vec3 vNormalView;
varying vec3 vToEye;
void main() {
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

function shell(color: string, opacity: number, rim: number): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    vertexShader: SHELL_VERTEX,
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
export function skinMaterial(): THREE.ShaderMaterial {
  return shell(SKIN_COLOR, 0.2, 2.6);
}

/** Bone that one looks into, for the placement in the score. */
export function glassBoneMaterial(color: string = BONE_COLOR): THREE.ShaderMaterial {
  return shell(color, 0.42, 1.9);
}

/** Only depth, so that of a see-through shell the nearest face alone is drawn. */
export function depthOnlyMaterial(): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({ colorWrite: false });
}

export function metalMaterial(color = "#c9d0d4", roughness = 0.24): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({ color, roughness, metalness: 1, envMapIntensity: 1.6 });
}

export function handleMaterial(): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({
    color: "#39444a",
    roughness: 0.5,
    metalness: 0.35,
    envMapIntensity: 0.6,
  });
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A dark gradient behind everything, dithered so that it shows no bands.
import * as THREE from "three";

export function backdrop(): THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial> {
  const geometry = new THREE.BufferGeometry();
  // One triangle that covers the screen.
  geometry.setAttribute(
    "position",
    new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3),
  );
  const material = new THREE.ShaderMaterial({
    vertexShader: /* glsl */ `
      varying vec2 vAt;
      void main() { vAt = position.xy; gl_Position = vec4(position.xy, 1.0, 1.0); }`,
    fragmentShader: /* glsl */ `
      varying vec2 vAt;
      void main() {
        float far = clamp(length(vAt * vec2(0.72, 0.8) - vec2(0.0, 0.12)), 0.0, 1.25) / 1.25;
        vec3 middle = vec3(0.135, 0.168, 0.184);
        vec3 edge = vec3(0.043, 0.055, 0.063);
        float grain = fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453) - 0.5;
        gl_FragColor = vec4(mix(middle, edge, smoothstep(0.0, 1.0, far)) + grain / 255.0, 1.0);
      }`,
    depthTest: false,
    depthWrite: false,
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = -10;
  return mesh;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A material of six fields as three.js renders one.
import * as THREE from "three";
import { roughnessOf, type Material, type Rgb } from "../appearance";

/** The standard's own reflectance is what half of the light stands for (case_io/glb.cpp). */
const HALF = new THREE.Color().setRGB(0.5, 0.5, 0.5, THREE.SRGBColorSpace).r;

function setColor(color: THREE.Color, [r, g, b]: Rgb): THREE.Color {
  return color.setRGB(r, g, b, THREE.SRGBColorSpace);
}

/** The six fields of a material as a microfacets' one. */
export function applyMaterial(to: THREE.MeshPhysicalMaterial, from: Material): void {
  setColor(to.color, from.diffuse);
  setColor(to.emissive, from.emissive);
  setColor(to.specularColor, from.specular).multiplyScalar(1 / HALF);
  to.envMapIntensity = from.ambient;
  to.roughness = roughnessOf(from);
  to.opacity = 1 - from.transparency;
  const isClear = from.transparency > 0;
  if (to.transparent !== isClear) {
    to.transparent = isClear;
    to.needsUpdate = true;
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bones cut open: their surfaces are left out on the viewer's side of a plane, and where one then looks
// onto a surface from within, the section is drawn, as the plane would show it. The section is painted on
// that inner surface, not on the plane, so that wire and screw in the bone are seen in it.
import * as THREE from "three";
import type { BoneMesh } from "./case_scene";
import { NOISE_GLSL } from "./materials";

const MM_PER_M = 1000;

export class CutBones {
  private readonly plane = new THREE.Plane();
  private readonly normalAndConstant = { value: new THREE.Vector4() };
  private readonly sections: readonly THREE.Mesh[];
  private isCut = false;

  constructor(private readonly bones: readonly BoneMesh[]) {
    const material = sectionMaterial(this.normalAndConstant);
    material.clippingPlanes = [this.plane];
    this.sections = bones.map((bone) => {
      const section = new THREE.Mesh(bone.geometry, material);
      section.visible = false;
      // Not hittable: the pointer finds the bone itself.
      section.raycast = () => undefined;
      bone.add(section);
      return section;
    });
  }

  /** @param plane  in the scene [m]; undefined: the bones are whole */
  cut(plane: THREE.Plane | undefined): void {
    if (plane !== undefined) {
      this.plane.copy(plane);
      const { normal, constant } = plane;
      this.normalAndConstant.value.set(normal.x, normal.y, normal.z, constant);
    }
    const isCut = plane !== undefined;
    if (isCut === this.isCut) return;
    this.isCut = isCut;
    for (const bone of this.bones) {
      bone.material.clippingPlanes = isCut ? [this.plane] : null;
      bone.material.clipShadows = isCut;
      bone.material.needsUpdate = true;
    }
    for (const section of this.sections) section.visible = isCut;
  }

  dispose(): void {
    const [first] = this.sections;
    if (first !== undefined) (first.material as THREE.Material).dispose();
    for (const section of this.sections) section.removeFromParent();
  }
}

/** Spongy bone where the line of sight meets the plane. */
function sectionMaterial(plane: { value: THREE.Vector4 }): THREE.Material {
  const material = new THREE.MeshBasicMaterial({ color: "#b9925f", side: THREE.BackSide });
  material.onBeforeCompile = (shader) => {
    shader.uniforms["cutPlane"] = plane;
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vSceneM;")
      .replace(
        "#include <project_vertex>",
        "#include <project_vertex>\nvSceneM = (modelMatrix * vec4(transformed, 1.0)).xyz;",
      );
    shader.fragmentShader = shader.fragmentShader
      .replace(
        "#include <common>",
        `#include <common>\nvarying vec3 vSceneM;\nuniform vec4 cutPlane;\n${NOISE_GLSL}`,
      )
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
vec3 sight = vSceneM - cameraPosition;
float ahead = -(dot(cutPlane.xyz, cameraPosition) + cutPlane.w) / dot(cutPlane.xyz, sight);
vec3 onPlaneMm = (cameraPosition + ahead * sight) * ${MM_PER_M.toFixed(1)};
float pores = 0.55 * noise3(onPlaneMm * 1.6) + 0.45 * noise3(onPlaneMm * 4.1);
// Near the cortex the inner surface is just behind the plane: dense, pale.
float behindMm = length(vSceneM - cameraPosition - ahead * sight) * ${MM_PER_M.toFixed(1)};
float dense = 1.0 - smoothstep(0.4, 1.6, behindMm);
diffuseColor.rgb *= mix(0.72 + 0.5 * pores, 1.35, dense);`,
      );
  };
  return material;
}

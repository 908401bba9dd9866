// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The host's scene: one node per bone and one for the skin, mm in the Patient frame.
import * as THREE from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { vertexOcclusion, type Surface } from "../bone_shading";
import { boneMaterial, depthOnlyMaterial, skinMaterial } from "./materials";

export interface CaseScene {
  /** All of it, in mm of the Patient frame. */
  readonly root: THREE.Group;
  readonly bones: readonly THREE.Mesh[];
  readonly skin: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial> | undefined;
  readonly skinDepth: THREE.Mesh | undefined;
}

/** Where no light reaches, bone is this part of its colour: warm, as fat and cartilage between. */
const DARK: readonly [number, number, number] = [0.16, 0.1, 0.075];

export async function loadCaseScene(url: string): Promise<CaseScene> {
  const loaded = await new GLTFLoader().loadAsync(url);
  const root = new THREE.Group();
  const bones: THREE.Mesh[] = [];
  let skin: CaseScene["skin"];
  let skinDepth: CaseScene["skinDepth"];
  loaded.scene.updateMatrixWorld(true);
  const material = boneMaterial();
  loaded.scene.traverse((node) => {
    if (!(node instanceof THREE.Mesh)) return;
    const mesh = node as THREE.Mesh;
    const name = mesh.name !== "" ? mesh.name : (mesh.parent?.name ?? "");
    const geometry = mesh.geometry.clone().applyMatrix4(mesh.matrixWorld);
    if (geometry.getAttribute("normal") === undefined) geometry.computeVertexNormals();
    if (name === "skin") {
      skinDepth = new THREE.Mesh(geometry, depthOnlyMaterial());
      skinDepth.renderOrder = 5;
      skin = new THREE.Mesh(geometry, skinMaterial());
      skin.renderOrder = 6;
      return;
    }
    const bone = new THREE.Mesh(geometry, material);
    bone.name = name;
    bone.castShadow = bone.receiveShadow = true;
    geometry.computeBoundingBox();
    geometry.computeBoundingSphere();
    bones.push(bone);
  });
  if (bones.length === 0) throw new Error("the scene holds no bones");
  shade(bones);
  root.add(...bones);
  if (skin !== undefined && skinDepth !== undefined) root.add(skinDepth, skin);
  return { root, bones, skin, skinDepth };
}

function shade(bones: readonly THREE.Mesh[]): void {
  const surfaces = bones.map((bone): Surface => {
    const array = (name: string): Float32Array =>
      new Float32Array(bone.geometry.getAttribute(name).array);
    return { positions: array("position"), normals: array("normal") };
  });
  vertexOcclusion(surfaces).forEach((light, index) => {
    const colors = new Float32Array(3 * light.length);
    for (let v = 0; v < light.length; ++v) {
      const lit = Math.pow(light[v] ?? 1, 1.7);
      for (let c = 0; c < 3; ++c) {
        const dark = DARK[c] ?? 0;
        colors[3 * v + c] = dark + (1 - dark) * lit;
      }
    }
    bones[index]?.geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
  });
}

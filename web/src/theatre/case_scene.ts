// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The host's scene: one node per bone, one for the skin, one per tendon, artery and nerve, mm in the
// Patient frame.
import * as THREE from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { vertexOcclusion, type Surface } from "../bone_shading";
import { makeHittable } from "./bone_rays";
import { boneMaterial } from "./materials";
import { Skin } from "./skin";
import type { SkinSide } from "./skin_blend_model";
import { structureFacts, Structures, type StructureSurface } from "./structures";

export type BoneMesh = THREE.Mesh<THREE.BufferGeometry, THREE.Material>;

export interface CaseScene {
  /** All of it, in mm of the Patient frame. */
  readonly root: THREE.Group;
  /** Each in a frame of its own, which is Patient's until it moves; hittable (bone_rays.ts). */
  readonly bones: readonly BoneMesh[];
  readonly skin: Skin | undefined;
  /** Each bone's own, by its name; none from a host that paints none. */
  readonly bitmaps: ReadonlyMap<string, THREE.Texture>;
  /** Empty in a case that was made before they were. */
  readonly structures: Structures;
  /** The insides of joints by their ids, generated, as scanned; none in a case without soft tissue. */
  readonly jointWalls: ReadonlyMap<string, THREE.BufferGeometry>;
}

/** Of their nodes; the joint's id follows. */
const JOINT_WALL = "joint_wall_";

/** Skin beyond the scan, by what carries it. */
const LIMBS: Readonly<Record<string, SkinSide>> = { limb_hand: "hand", limb_forearm: "forearm" };

/** Where no light reaches, bone is this part of its colour: warm, as fat and cartilage between. */
const DARK: readonly [number, number, number] = [0.16, 0.1, 0.075];

export async function loadCaseScene(url: string): Promise<CaseScene> {
  const loaded = await new GLTFLoader().loadAsync(url);
  const root = new THREE.Group();
  const bones: BoneMesh[] = [];
  const bitmaps = new Map<string, THREE.Texture>();
  const structures: StructureSurface[] = [];
  let skinSurface: THREE.BufferGeometry | undefined;
  const limbs = new Map<SkinSide, THREE.BufferGeometry>();
  const jointWalls = new Map<string, THREE.BufferGeometry>();
  loaded.scene.updateMatrixWorld(true);
  loaded.scene.traverse((node) => {
    if (!(node instanceof THREE.Mesh)) return;
    const mesh = node as THREE.Mesh;
    const name = mesh.name !== "" ? mesh.name : (mesh.parent?.name ?? "");
    const geometry = mesh.geometry.clone().applyMatrix4(mesh.matrixWorld);
    if (geometry.getAttribute("normal") === undefined) geometry.computeVertexNormals();
    const facts = structureFacts(mesh.userData) ?? structureFacts(mesh.parent?.userData);
    if (facts !== undefined) structures.push({ facts, geometry });
    else if (name === "skin") skinSurface = geometry;
    else if (LIMBS[name] !== undefined) limbs.set(LIMBS[name], geometry);
    else if (name.startsWith(JOINT_WALL)) jointWalls.set(name.slice(JOINT_WALL.length), geometry);
    else {
      bones.push(makeBone(name, geometry));
      const { material } = mesh;
      if (material instanceof THREE.MeshStandardMaterial && material.map !== null) {
        bitmaps.set(name, material.map);
      }
    }
  });
  if (bones.length === 0) throw new Error("the scene holds no bones");
  shade(bones);
  root.add(...bones);
  const skin = skinSurface === undefined ? undefined : new Skin(skinSurface, bones, limbs);
  if (skin !== undefined) root.add(skin.group);
  const tubes = new Structures(structures, new Set(bones.map((bone) => bone.name)));
  root.add(tubes.group);
  return { root, bones, skin, bitmaps, structures: tubes, jointWalls };
}

function makeBone(name: string, geometry: THREE.BufferGeometry): BoneMesh {
  const bone = new THREE.Mesh(geometry, boneMaterial());
  bone.name = name;
  bone.castShadow = bone.receiveShadow = true;
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
  makeHittable(bone);
  return bone;
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

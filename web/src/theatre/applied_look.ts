// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Gives the case's surfaces the materials of a look, their bitmaps, their facets' edges and their hulls.
import * as THREE from "three";
import { ConvexGeometry } from "three/examples/jsm/geometries/ConvexGeometry.js";
import type { Look } from "../appearance";
import { applyMaterial } from "./apply_material";
import type { BoneMesh, CaseScene } from "./case_scene";

/** Of a hull's faces, so that its edges are drawn and not its triangles [degrees]. */
const EDGE_DEG = 6;

/** Over a surface and not in the pointer's way. */
function over(
  bone: BoneMesh,
  geometry: THREE.BufferGeometry,
  material: THREE.Material,
): THREE.Mesh {
  const mesh = new THREE.Mesh(geometry, material);
  mesh.raycast = () => undefined;
  bone.add(mesh);
  return mesh;
}

export class AppliedLook {
  private readonly lines = new THREE.MeshBasicMaterial({
    color: "#1d1509",
    wireframe: true,
    transparent: true,
    opacity: 0.26,
    polygonOffset: true,
    polygonOffsetFactor: -1,
    polygonOffsetUnits: -1,
  });
  private readonly shell = new THREE.MeshStandardMaterial({
    color: "#4f93f0",
    transparent: true,
    opacity: 0.3,
    depthWrite: false,
    flatShading: true,
  });
  private readonly edges = new THREE.LineBasicMaterial({
    color: "#9cc7ff",
    transparent: true,
    opacity: 0.5,
  });
  private facets: readonly THREE.Mesh[] | undefined;
  private hulls: readonly THREE.Mesh[] | undefined;

  constructor(private readonly scene: CaseScene) {}

  apply(look: Look): void {
    const { bones, bitmaps, structures } = this.scene;
    for (const bone of bones) {
      const { material } = bone;
      if (!(material instanceof THREE.MeshPhysicalMaterial)) continue;
      applyMaterial(material, look.materials.bone);
      const map = look.texture ? (bitmaps.get(bone.name) ?? null) : null;
      if (material.map !== map) {
        material.map = map;
        material.needsUpdate = true;
      }
    }
    structures.apply(look.materials);
    if (look.facets) {
      this.facets ??= bones.map((bone) => over(bone, bone.geometry, this.lines));
    }
    if (look.hulls) this.hulls ??= bones.map((bone) => this.hull(bone));
    for (const mesh of this.facets ?? []) mesh.visible = look.facets;
    for (const mesh of this.hulls ?? []) mesh.visible = look.hulls;
  }

  private hull(bone: BoneMesh): THREE.Mesh {
    const geometry = hullOf(bone);
    const hull = over(bone, geometry, this.shell);
    const edges = new THREE.LineSegments(new THREE.EdgesGeometry(geometry, EDGE_DEG), this.edges);
    edges.raycast = () => undefined;
    hull.add(edges);
    return hull;
  }

  dispose(): void {
    this.edges.dispose();
    this.lines.dispose();
    this.shell.dispose();
  }
}

function hullOf(bone: BoneMesh): THREE.BufferGeometry {
  const position = bone.geometry.getAttribute("position");
  const points: THREE.Vector3[] = [];
  for (let i = 0; i < position.count; ++i) {
    points.push(new THREE.Vector3().fromBufferAttribute(position, i));
  }
  return new ConvexGeometry(points);
}

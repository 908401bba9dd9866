// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The joints' bones with what was seen of their cartilage, the rows drawn apart so that both sides of
// each joint can be looked at.
import * as THREE from "three";
import { faceNames, makeFrameMap, towards } from "../frames";
import type { CaseDescription, ScuffedPlace, SeenCartilage } from "../protocol";
import { loadCaseScene, studioLight } from "../theatre";
import { paintedVertices, rowOf, type Painted } from "./cartilage_model";
import type { TurnedWorld } from "./turning_view";

/** Dots lie on the surface like beads: light, so that they stand out from both paints. */
const SCUFF_MM = 0.8;
const SCUFF_COLOR = "#ff2d55";
const APART_M = 0.016;
/** Told apart without colour too: what was missed is the darker. */
const COLORS: Readonly<Record<Painted, string>> = {
  bone: "#cfc6b4",
  seen: "#69d39a",
  missed: "#b06a1e",
};

export async function makeCartilageWorld(
  renderer: THREE.WebGLRenderer,
  description: CaseDescription,
  seen: SeenCartilage,
  scuffs: readonly ScuffedPlace[],
): Promise<TurnedWorld> {
  const scene = await loadCaseScene("/api/scene.glb");
  const frames = makeFrameMap(description.wrist_from_patient);
  const distal = new THREE.Vector3(...towards("Distal", faceNames(description.side)));
  const world = new THREE.Scene();
  const light = studioLight(renderer, world);
  const box = new THREE.Box3();
  const dot = new THREE.SphereGeometry(SCUFF_MM, 20, 12);
  const dotMaterial = new THREE.MeshBasicMaterial({ color: SCUFF_COLOR });
  const marks: { name: string; at: THREE.Vector3 }[] = [];
  for (const bone of scene.bones) {
    const cartilage = seen.bones.find((one) => one.bone === bone.name);
    if (cartilage === undefined) continue;
    const geometry = bone.geometry.clone();
    const positions = geometry.getAttribute("position").array;
    const painted = paintedVertices(cartilage, positions);
    const colors = painted.flatMap((what) => new THREE.Color(COLORS[what]).toArray());
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
    const material = new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.6 });
    const row = new THREE.Group();
    row.position.copy(distal).multiplyScalar(APART_M * rowOf(bone.name));
    const patient = new THREE.Group();
    patient.matrixAutoUpdate = false;
    patient.matrix.fromArray([...frames.matrix]);
    patient.add(new THREE.Mesh(geometry, material));
    row.add(patient);
    const own = scuffs.flatMap((scuff, index) =>
      scuff.bone === bone.name ? [{ name: String(index + 1), at: scuff.at_mm }] : [],
    );
    for (const { at } of own) {
      const bead = new THREE.Mesh(dot, dotMaterial);
      bead.position.set(...at);
      patient.add(bead);
    }
    world.add(row);
    row.updateMatrixWorld(true);
    for (const { name, at } of own) {
      marks.push({ name, at: new THREE.Vector3(...at).applyMatrix4(patient.matrixWorld) });
    }
    painted.forEach((what, v) => {
      if (what === "bone") return; // of a long bone the end alone is looked at
      const at = new THREE.Vector3().fromArray(positions, 3 * v);
      box.expandByPoint(at.applyMatrix4(patient.matrixWorld));
    });
  }
  return { world, light, box, marks };
}

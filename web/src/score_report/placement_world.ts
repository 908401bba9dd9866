// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the placement is drawn of: the scaphoid see-through, the central axis, wire and screw, and where
// it was entered and where its tip lies.
import * as THREE from "three";
import { makeFrameMap, type FrameMap } from "../frames";
import type { BodyPose, CaseDescription, Placement, PlacedAxis, Vec3 } from "../protocol";
import {
  alignShaft,
  drawInstrument,
  glassBoneMaterial,
  loadCaseScene,
  studioLight,
} from "../theatre";
import { normalized, subtract } from "../tool_placement";
import { placedScrewParts, placedWireParts } from "./placed_parts";
import type { TurnedWorld } from "./turning_view";

const AXIS_COLOR = "#5cc8ff";
const ENTRY_COLOR = "#f0c36a";
const TIP_COLOR = "#ffffff";
const MARK_RADIUS_MM = 0.55;

/** Of the scaphoid; marks are entry and tip of what was placed, none where nothing was. */
export interface PlacementWorld extends TurnedWorld {
  readonly frames: FrameMap;
}

export async function makePlacementWorld(
  renderer: THREE.WebGLRenderer,
  description: CaseDescription,
  placement: Placement,
): Promise<PlacementWorld> {
  const scene = await loadCaseScene("/api/scene.glb");
  const frames = makeFrameMap(description.wrist_from_patient);
  const world = new THREE.Scene();
  const light = studioLight(renderer, world);
  const patient = new THREE.Group();
  patient.matrixAutoUpdate = false;
  patient.matrix.fromArray([...frames.matrix]);
  world.add(patient);
  const box = new THREE.Box3();
  for (const bone of scene.bones) {
    if (!bone.name.startsWith("scaphoid")) continue;
    bone.material = glassBoneMaterial();
    const piece = placement.pieces?.find(({ name }) => name === bone.name);
    if (piece !== undefined) lay(bone, piece.pose);
    bone.renderOrder = 4;
    patient.add(bone);
  }
  const places = placesOf(placement);
  patient.add(...hardware(placement), ...places.map((place) => markAt(place.mm, place.color)));
  world.updateMatrixWorld(true);
  for (const child of patient.children) {
    if (child.name.startsWith("scaphoid")) box.expandByObject(child);
  }
  const marks = places.map(({ name, mm }) => ({
    name,
    at: new THREE.Vector3(...mm).applyMatrix4(patient.matrix),
  }));
  return { world, light, frames, box, marks };
}

/** Where the piece lies at the end, seen from the one with the line. */
function lay(bone: THREE.Object3D, { quaternion, translation_mm }: BodyPose): void {
  const [w, x, y, z] = quaternion;
  bone.quaternion.set(x, y, z, w);
  bone.position.set(...translation_mm);
}

/** Of the screw; of the wire where no screw was placed. */
function placesOf({ wire, screw }: Placement): { name: string; mm: Vec3; color: string }[] {
  const entry = screw?.tail_mm ?? wire?.entry_mm;
  const tip = screw?.tip_mm ?? wire?.tip_mm;
  if (entry === undefined || tip === undefined) return [];
  return [
    { name: "entry", mm: entry, color: ENTRY_COLOR },
    { name: "tip", mm: tip, color: TIP_COLOR },
  ];
}

function markAt(mm: Vec3, color: string): THREE.Object3D {
  const material = new THREE.MeshBasicMaterial({
    color,
    depthTest: false,
    transparent: true,
    opacity: 0.9,
    toneMapped: false,
  });
  const mesh = new THREE.Mesh(new THREE.SphereGeometry(MARK_RADIUS_MM, 16, 12), material);
  mesh.position.set(...mm);
  mesh.renderOrder = 9;
  return mesh;
}

function hardware(placement: Placement): THREE.Object3D[] {
  const objects: THREE.Object3D[] = [axisLine(placement.central_axis)];
  const { wire, screw } = placement;
  if (wire !== null) {
    const shaft = normalized(subtract(wire.entry_mm, wire.tip_mm));
    // With 12 mm of what stands out, to show where it came in.
    const lengthMm = Math.hypot(...subtract(wire.entry_mm, wire.tip_mm)) + 12;
    const drawn = drawInstrument(placedWireParts(lengthMm));
    alignShaft(drawn, wire.tip_mm, shaft);
    objects.push(drawn);
  }
  if (screw !== null) {
    const length_mm = Math.hypot(...subtract(screw.tail_mm, screw.tip_mm));
    const drawn = drawInstrument(placedScrewParts(screw, length_mm));
    alignShaft(drawn, screw.tip_mm, normalized(subtract(screw.tail_mm, screw.tip_mm)));
    objects.push(drawn);
  }
  return objects;
}

/** The central axis, drawn 3 mm beyond both poles and over everything. */
function axisLine(axis: PlacedAxis): THREE.Object3D {
  const along = normalized(subtract(axis.proximal_mm, axis.distal_mm));
  const lengthMm = Math.hypot(...subtract(axis.proximal_mm, axis.distal_mm)) + 6;
  const geometry = new THREE.CylinderGeometry(0.18, 0.18, lengthMm, 12);
  geometry.rotateX(Math.PI / 2).translate(0, 0, lengthMm / 2);
  const material = new THREE.MeshBasicMaterial({
    color: AXIS_COLOR,
    depthTest: false,
    transparent: true,
    opacity: 0.95,
    toneMapped: false,
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.renderOrder = 8;
  const start: Vec3 = [
    axis.distal_mm[0] - 3 * along[0],
    axis.distal_mm[1] - 3 * along[1],
    axis.distal_mm[2] - 3 * along[2],
  ];
  alignShaft(mesh, start, along);
  return mesh;
}

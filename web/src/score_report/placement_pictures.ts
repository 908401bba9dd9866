// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The placement in see-through bone with the central axis, from three sides, as still pictures: they
// print, and nothing keeps running behind the report.
import * as THREE from "three";
import { make } from "../dom";
import { faceNames, makeFrameMap, towards, type AnatomicalSide, type FrameMap } from "../frames";
import type { CaseDescription, Placement, PlacedAxis, Side, Vec3 } from "../protocol";
import {
  alignShaft,
  drawInstrument,
  glassBoneMaterial,
  loadCaseScene,
  studioLight,
} from "../theatre";
import { normalized, subtract } from "../tool_placement";
import { placedScrewParts, placedWireParts } from "./placed_parts";

interface Look {
  readonly name: string;
  readonly from: THREE.Vector3;
  readonly up: THREE.Vector3;
}

const SIDE_PX = 720;
const AXIS_COLOR = "#5cc8ff";
/** The frame leaves this much beside the scaphoid [m]. */
const MARGIN_M = 0.004;

/** @return pictures with their captions; an empty list where they cannot be drawn. */
export async function placementPictures(
  description: CaseDescription,
  placement: Placement,
): Promise<HTMLElement[]> {
  const scene = await loadCaseScene("/api/scene.glb");
  const frames = makeFrameMap(description.wrist_from_patient);
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(1);
  renderer.setSize(SIDE_PX, SIDE_PX, false);
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  renderer.setClearColor("#11171a");
  const world = new THREE.Scene();
  const light = studioLight(renderer, world);
  const patient = new THREE.Group();
  patient.matrixAutoUpdate = false;
  patient.matrix.fromArray([...frames.matrix]);
  world.add(patient);
  const box = new THREE.Box3();
  for (const bone of scene.bones) {
    const scaphoid = bone.name.startsWith("scaphoid");
    if (!scaphoid) continue;
    bone.material = glassBoneMaterial();
    bone.renderOrder = 4;
    patient.add(bone);
  }
  patient.add(...hardware(placement));
  world.updateMatrixWorld(true);
  for (const child of patient.children) {
    if (child.name.startsWith("scaphoid")) box.expandByObject(child);
  }
  const pictures = looks(placement.central_axis, frames, description.side).map((look) =>
    picture(renderer, world, light, box, look),
  );
  light.dispose();
  renderer.dispose();
  renderer.forceContextLoss();
  return pictures;
}

function looks(central: PlacedAxis, frames: FrameMap, side: Side): Look[] {
  const axis = normalized(subtract(central.proximal_mm, central.distal_mm));
  const along = new THREE.Vector3(...frames.directionToRenderer(axis));
  const names = faceNames(side);
  const to = (name: AnatomicalSide): THREE.Vector3 => new THREE.Vector3(...towards(name, names));
  // Two across the axis, which runs nearly from dorsal to volar in the flexed wrist, and one along it.
  return [
    { name: "From radial", from: to("Radial"), up: to("Distal") },
    { name: "From distal", from: to("Distal"), up: to("Dorsal") },
    { name: "Along the axis, from proximal", from: along, up: to("Distal") },
  ];
}

function picture(
  renderer: THREE.WebGLRenderer,
  world: THREE.Scene,
  light: ReturnType<typeof studioLight>,
  box: THREE.Box3,
  look: Look,
): HTMLElement {
  const size = box.getSize(new THREE.Vector3());
  const half = Math.max(size.x, size.y, size.z) / 2 + MARGIN_M;
  const centre = box.getCenter(new THREE.Vector3());
  const camera = new THREE.OrthographicCamera(-half, half, half, -half, 0.01, 1);
  camera.up.copy(look.up);
  camera.position.copy(centre).addScaledVector(look.from, 0.3);
  camera.lookAt(centre);
  camera.updateMatrixWorld(true);
  light.follow(camera, centre);
  renderer.render(world, camera);
  const canvas = make("canvas", { width: String(SIDE_PX), height: String(SIDE_PX), role: "img" });
  canvas.setAttribute("aria-label", `Placement in the scaphoid, ${look.name.toLowerCase()}`);
  canvas.getContext("2d")?.drawImage(renderer.domElement, 0, 0);
  return make("figure", {}, canvas, make("figcaption", {}, look.name));
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

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The placement in see-through bone with the central axis, from three sides, as still pictures: they
// print, and nothing keeps running behind the report.
import * as THREE from "three";
import { make } from "../dom";
import { faceNames, towards, type AnatomicalSide, type FrameMap } from "../frames";
import type { CaseDescription, Placement, PlacedAxis, Side } from "../protocol";
import { normalized, subtract } from "../tool_placement";
import { makePlacementWorld, type PlacementWorld } from "./placement_world";

interface Look {
  readonly name: string;
  readonly from: THREE.Vector3;
  readonly up: THREE.Vector3;
}

const SIDE_PX = 720;
/** The frame leaves this much beside the scaphoid [m]. */
const MARGIN_M = 0.004;

/** @return pictures with their captions; an empty list where they cannot be drawn. */
export async function placementPictures(
  description: CaseDescription,
  placement: Placement,
): Promise<HTMLElement[]> {
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(1);
  renderer.setSize(SIDE_PX, SIDE_PX, false);
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  renderer.setClearColor("#11171a");
  const placed = await makePlacementWorld(renderer, description, placement);
  const pictures = looks(placement.central_axis, placed.frames, description.side).map((look) =>
    picture(renderer, placed, look),
  );
  placed.light.dispose();
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
  { world, light, box }: PlacementWorld,
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

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Names beside the bones, with a leader line to each; two columns so that none overlap. While tendons,
// arteries and nerves are shown it is they that are named: both would not fit.
import * as THREE from "three";
import { linesOf, roomAside, spread, type Label } from "./label_model";
import type { Structures } from "./structures";

interface Named extends Label {
  readonly text: string;
  lines: readonly string[];
  readonly bone: THREE.Object3D;
  /** In the bone's own frame: the leader goes where the bone goes. */
  readonly centre: THREE.Vector3;
  x: number;
}

const FONT = "500 13px 'Inter Variable', sans-serif";
const LINE_PX = 16;
const GAP_PX = 6;
const MARGIN_PX = 12;
/** Below the lowest name: what the colours mean, and on the left the cube that tells the sides. */
const FOOT_PX = 36;
const CUBE_FOOT_PX = 108;

/** "scaphoid_proximal" to "Scaphoid, proximal part"; "metacarpal3" to "Metacarpal 3". */
export function boneLabel(name: string): string {
  const [bone = "", part] = name.split("_");
  const spaced = bone.replace(/(\d+)$/, " $1");
  const capital = spaced.charAt(0).toUpperCase() + spaced.slice(1);
  return part === undefined ? capital : `${capital}, ${part} part`;
}

function naming(text: string, bone: THREE.Object3D, centre: THREE.Vector3): Named {
  return { text, lines: [text], bone, centre, x: 0, y: 0, labelY: 0, height: 0, left: false };
}

export class BoneNames {
  readonly canvas = document.createElement("canvas");
  private readonly context = this.canvas.getContext("2d");
  private readonly bones: readonly Named[];
  private readonly tubes: readonly Named[];
  /** For this much room the names are broken into lines. */
  private room = 0;
  private readonly projected = new THREE.Vector3();

  constructor(
    bones: readonly THREE.Mesh[],
    private readonly structures: Structures,
  ) {
    this.canvas.className = "bone-names";
    this.canvas.setAttribute("aria-hidden", "true");
    this.bones = bones.map((bone) => {
      const centre = new THREE.Vector3();
      bone.geometry.boundingBox?.getCenter(centre);
      return naming(boneLabel(bone.name), bone, centre);
    });
    this.tubes = structures.markers.map((marker) => {
      const text = marker.name.charAt(0).toUpperCase() + marker.name.slice(1);
      return naming(text, marker, new THREE.Vector3());
    });
  }

  resize(width: number, height: number, ratio: number): void {
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.context?.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  draw(camera: THREE.Camera, width: number, height: number): void {
    const context = this.context;
    if (context === null) return;
    context.clearRect(0, 0, width, height);
    context.font = FONT;
    context.textBaseline = "middle";
    context.lineJoin = "round";
    this.breakLines(context, roomAside(width));
    const named = this.structures.group.visible ? this.tubes : this.bones;
    for (const bone of named) {
      this.projected.copy(bone.centre).applyMatrix4(bone.bone.matrixWorld).project(camera);
      bone.x = (0.5 + 0.5 * this.projected.x) * width;
      bone.y = (0.5 - 0.5 * this.projected.y) * height;
      bone.left = bone.x < width / 2;
    }
    spread(named, true, MARGIN_PX, height - CUBE_FOOT_PX);
    spread(named, false, MARGIN_PX, height - FOOT_PX);
    for (const bone of named) drawLeader(context, bone, width);
    for (const bone of named) drawName(context, bone, width);
  }

  private breakLines(context: CanvasRenderingContext2D, room: number): void {
    if (room === this.room) return;
    this.room = room;
    const measure = (text: string): number => context.measureText(text).width;
    for (const bone of [...this.bones, ...this.tubes]) {
      bone.lines = linesOf(bone.text, room, measure);
      bone.height = bone.lines.length * LINE_PX + GAP_PX;
    }
  }
}

function drawLeader(context: CanvasRenderingContext2D, bone: Named, width: number): void {
  const longest = Math.max(...bone.lines.map((line) => context.measureText(line).width));
  const end = MARGIN_PX + longest + 6;
  context.strokeStyle = "rgba(159, 176, 183, 0.7)";
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(bone.left ? end : width - end, bone.labelY);
  context.lineTo(bone.x, bone.y);
  context.stroke();
  context.fillStyle = "#e8eef0";
  context.beginPath();
  context.arc(bone.x, bone.y, 2.2, 0, 2 * Math.PI);
  context.fill();
}

/** Readable over whatever it happens to lie on. */
function drawName(context: CanvasRenderingContext2D, bone: Named, width: number): void {
  context.textAlign = bone.left ? "left" : "right";
  const x = bone.left ? MARGIN_PX : width - MARGIN_PX;
  const top = bone.labelY - ((bone.lines.length - 1) * LINE_PX) / 2;
  context.strokeStyle = "rgba(14, 18, 20, 0.85)";
  context.lineWidth = 4;
  context.fillStyle = "#e8eef0";
  bone.lines.forEach((line, index) => {
    context.strokeText(line, x, top + index * LINE_PX);
    context.fillText(line, x, top + index * LINE_PX);
  });
}

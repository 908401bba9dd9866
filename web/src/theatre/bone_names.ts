// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Names beside the bones, with a leader line to each; two columns so that none overlap. While tendons,
// arteries and nerves are shown it is they that are named: both would not fit.
import * as THREE from "three";
import type { Structures } from "./structures";

interface Named {
  readonly text: string;
  readonly bone: THREE.Object3D;
  /** In the bone's own frame: the leader goes where the bone goes. */
  readonly centre: THREE.Vector3;
  x: number;
  y: number;
  labelY: number;
  left: boolean;
}

const LINE_PX = 22;
const MARGIN_PX = 16;

/** "scaphoid_proximal" to "Scaphoid, proximal part"; "metacarpal3" to "Metacarpal 3". */
export function boneLabel(name: string): string {
  const [bone = "", part] = name.split("_");
  const spaced = bone.replace(/(\d+)$/, " $1");
  const capital = spaced.charAt(0).toUpperCase() + spaced.slice(1);
  return part === undefined ? capital : `${capital}, ${part} part`;
}

export class BoneNames {
  readonly canvas = document.createElement("canvas");
  private readonly context = this.canvas.getContext("2d");
  private readonly bones: Named[];
  private readonly tubes: Named[];
  private named: Named[];
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
      return { text: boneLabel(bone.name), bone, centre, x: 0, y: 0, labelY: 0, left: false };
    });
    this.tubes = structures.markers.map((marker) => ({
      text: marker.name.charAt(0).toUpperCase() + marker.name.slice(1),
      bone: marker,
      centre: new THREE.Vector3(),
      x: 0,
      y: 0,
      labelY: 0,
      left: false,
    }));
    this.named = this.bones;
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
    this.named = this.structures.group.visible ? this.tubes : this.bones;
    for (const bone of this.named) {
      this.projected.copy(bone.centre).applyMatrix4(bone.bone.matrixWorld).project(camera);
      bone.x = (0.5 + 0.5 * this.projected.x) * width;
      bone.y = (0.5 - 0.5 * this.projected.y) * height;
      bone.left = bone.x < width / 2;
      bone.labelY = bone.y;
    }
    this.named.sort(byHeight);
    this.spread(true, height);
    this.spread(false, height);
    context.font = "500 14px 'Inter Variable', sans-serif";
    context.textBaseline = "middle";
    context.lineWidth = 1;
    for (const bone of this.named) this.drawOne(context, bone, width);
  }

  /** Pushes the labels of one column apart, downwards, then back up from the bottom. */
  private spread(left: boolean, height: number): void {
    let free = MARGIN_PX + LINE_PX / 2;
    for (const bone of this.named) {
      if (bone.left !== left) continue;
      bone.labelY = Math.max(bone.labelY, free);
      free = bone.labelY + LINE_PX;
    }
    let bottom = height - MARGIN_PX;
    for (let i = this.named.length - 1; i >= 0; --i) {
      const bone = this.named[i];
      if (bone?.left !== left) continue;
      bone.labelY = Math.min(bone.labelY, bottom);
      bottom = bone.labelY - LINE_PX;
    }
  }

  private drawOne(context: CanvasRenderingContext2D, bone: Named, width: number): void {
    const edge = bone.left ? MARGIN_PX : width - MARGIN_PX;
    context.textAlign = bone.left ? "left" : "right";
    const end = bone.left
      ? edge + context.measureText(bone.text).width + 8
      : edge - context.measureText(bone.text).width - 8;
    context.strokeStyle = "rgba(159, 176, 183, 0.7)";
    context.beginPath();
    context.moveTo(end, bone.labelY);
    context.lineTo(bone.x, bone.y);
    context.stroke();
    context.fillStyle = "#e8eef0";
    context.beginPath();
    context.arc(bone.x, bone.y, 2.2, 0, 2 * Math.PI);
    context.fill();
    context.fillText(bone.text, edge, bone.labelY);
  }
}

function byHeight(a: Named, b: Named): number {
  return a.y - b.y;
}

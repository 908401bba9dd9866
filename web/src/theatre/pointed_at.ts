// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From the page to the bones and back: what lies under the pointer, and where a point is shown.
import * as THREE from "three";
import type { FrameMap } from "../frames";
import type { Vec3 } from "../protocol";
import type { BoneRays } from "./bone_rays";

/** A place on the page [CSS px]. */
export interface PagePoint {
  readonly x: number;
  readonly y: number;
}

export class PointedAt {
  private readonly caster = new THREE.Raycaster();
  private readonly pointer = new THREE.Vector2();
  private readonly scratch = new THREE.Vector3();
  private readonly forward = new THREE.Vector3();

  /** @param patient  Patient mm to renderer metres, the same as `frames` */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly camera: THREE.Camera,
    private readonly rays: BoneRays,
    private readonly patient: THREE.Matrix4,
    private readonly frames: FrameMap,
  ) {}

  /** The point of a bone under the pointer, in Patient [mm]. */
  boneAt(clientX: number, clientY: number): Vec3 | undefined {
    this.aim(clientX, clientY);
    const hit = this.rays.first(this.caster, this.scratch);
    return hit ? this.frames.pointToPatient(...this.scratch.toArray()) : undefined;
  }

  /** The point under the pointer at the depth of `nearMm`, in Patient [mm]. */
  planeAt(clientX: number, clientY: number, nearMm: Vec3): Vec3 {
    this.aim(clientX, clientY);
    this.camera.getWorldDirection(this.forward);
    this.scratch.set(...nearMm).applyMatrix4(this.patient);
    const depth = this.scratch.sub(this.camera.position).dot(this.forward);
    const { direction, origin } = this.caster.ray;
    const along = depth / direction.dot(this.forward);
    const point = this.scratch.copy(origin).addScaledVector(direction, along);
    return this.frames.pointToPatient(point.x, point.y, point.z);
  }

  /** The bone's point on the line of sight through `pointMm`, in Patient [mm]. */
  boneBehind(pointMm: Vec3): Vec3 | undefined {
    const { x, y } = this.pagePoint(pointMm);
    return this.boneAt(x, y);
  }

  /** Where a point of Patient [mm] is on the page. */
  pagePoint(pointMm: Vec3): PagePoint {
    this.scratch
      .set(...pointMm)
      .applyMatrix4(this.patient)
      .project(this.camera);
    const rect = this.canvas.getBoundingClientRect();
    return {
      x: rect.left + (0.5 + 0.5 * this.scratch.x) * rect.width,
      y: rect.top + (0.5 - 0.5 * this.scratch.y) * rect.height,
    };
  }

  private aim(clientX: number, clientY: number): void {
    const rect = this.canvas.getBoundingClientRect();
    this.pointer.set(
      (2 * (clientX - rect.left)) / rect.width - 1,
      1 - (2 * (clientY - rect.top)) / rect.height,
    );
    this.camera.updateMatrixWorld();
    this.caster.setFromCamera(this.pointer, this.camera);
  }
}

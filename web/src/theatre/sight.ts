// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From where one looks: the camera, the named views, turning and nearing.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { towards, type FaceNames, type FrameMap } from "../frames";
import type { Vec3 } from "../protocol";

export const VIEWS = ["dorsal", "radial", "volar", "ulnar", "wire"] as const;
export type ViewId = (typeof VIEWS)[number];

/** The sides of the forearm as it is held, as for the C-arm: Dorsal looks along the beam of PA. */
const SIDES = { dorsal: "Dorsal", radial: "Radial", volar: "Volar", ulnar: "Ulnar" } as const;
type Side = keyof typeof SIDES;
const FIELD_OF_VIEW_DEG = 26;
const DISTANCE_M = 0.225;
const WIRE_DISTANCE_M = 0.16;
const NEAREST_M = 0.05;
const FARTHEST_M = 0.8;
/** Straight from above or below right and left would lose their meaning [rad]. */
const POLE_RAD = 0.05;
/** A preset is left once the sight turns by more than this, or the wire's tip goes beside it [m]. */
const SAME_SIGHT_COSINE = Math.cos((1.5 * Math.PI) / 180);
const SAME_TIP_M = 0.002;

/** The line of an instrument in Patient [mm], its shaft towards the hand. */
export interface ToolLine {
  readonly tip_mm: Vec3;
  readonly shaft: Vec3;
}

export class Sight {
  readonly camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.01, 3);
  private readonly controls: OrbitControls;
  private readonly spherical = new THREE.Spherical();
  private readonly scratch = new THREE.Vector3();
  private readonly forward = new THREE.Vector3();
  /** The preset that is still looked from, and its direction towards the viewer. */
  private view: ViewId | undefined = undefined;
  private readonly viewedFrom = new THREE.Vector3();
  /** Another picture is to be seen. */
  onChange: (() => void) | undefined;
  /** The camera or, along it, the wire has left the preset. */
  onViewLeft: (() => void) | undefined;

  /**
   * @param home  what the views look at [m]
   * @param patient  Patient mm to renderer metres
   */
  constructor(
    canvas: HTMLCanvasElement,
    private readonly home: THREE.Vector3,
    private readonly patient: THREE.Matrix4,
    private readonly frames: FrameMap,
    private readonly facing: FaceNames,
  ) {
    this.controls = new OrbitControls(this.camera, canvas);
    this.setDragLooks(false);
    this.controls.minDistance = NEAREST_M;
    this.controls.maxDistance = FARTHEST_M;
    this.controls.zoomSpeed = 0.8;
    this.controls.addEventListener("change", () => {
      this.onChange?.();
    });
    this.lookFrom("dorsal", undefined);
  }

  /** Whether the main button or one finger turns the view: two fingers shift it then, else they turn it. */
  setDragLooks(on: boolean): void {
    const { DOLLY_PAN, DOLLY_ROTATE, ROTATE } = THREE.TOUCH;
    this.controls.mouseButtons = {
      LEFT: on ? THREE.MOUSE.ROTATE : null,
      MIDDLE: THREE.MOUSE.PAN,
      RIGHT: THREE.MOUSE.ROTATE,
    };
    this.controls.touches = on ? { ONE: ROTATE, TWO: DOLLY_PAN } : { ONE: null, TWO: DOLLY_ROTATE };
  }

  get target(): THREE.Vector3 {
    return this.controls.target;
  }

  setAspect(aspect: number): void {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** @param tool  what "wire" looks along; without one that view is not taken */
  lookFrom(view: ViewId, tool: ToolLine | undefined): void {
    const { target } = this;
    const at = this.camera.position;
    if (view === "wire") {
      if (tool === undefined) return;
      at.set(...this.frames.directionToRenderer(tool.shaft));
      target.set(...tool.tip_mm).applyMatrix4(this.patient);
    } else {
      at.set(...towards(SIDES[view], this.facing));
      target.copy(this.home);
    }
    at.normalize()
      .multiplyScalar(view === "wire" ? WIRE_DISTANCE_M : DISTANCE_M)
      .add(target);
    this.camera.lookAt(target);
    this.controls.update();
    this.view = view;
    this.viewedFrom.copy(at).sub(target).normalize();
    this.onChange?.();
  }

  /** What is looked at has another place: the preset is taken anew, if it is still the view. */
  lookAgain(tool: ToolLine | undefined): void {
    if (this.view !== undefined) this.lookFrom(this.view, tool);
  }

  /** Says once when the preset is left. */
  watch(tool: ToolLine | undefined): void {
    if (this.view === undefined || this.holds(this.view, tool)) return;
    this.view = undefined;
    this.onViewLeft?.();
  }

  private holds(view: ViewId, tool: ToolLine | undefined): boolean {
    const { scratch, target } = this;
    scratch.copy(this.camera.position).sub(target).normalize();
    if (scratch.dot(this.viewedFrom) < SAME_SIGHT_COSINE) return false;
    if (view !== "wire" || tool === undefined) return true;
    const { shaft, tip_mm } = tool;
    scratch.set(shaft[0], shaft[1], shaft[2]).transformDirection(this.patient);
    if (scratch.dot(this.viewedFrom) < SAME_SIGHT_COSINE) return false;
    scratch.set(tip_mm[0], tip_mm[1], tip_mm[2]).applyMatrix4(this.patient).sub(target);
    scratch.addScaledVector(this.viewedFrom, -scratch.dot(this.viewedFrom));
    return scratch.length() < SAME_TIP_M;
  }

  /** Turns the view about what it looks at [rad]. */
  orbit(rightRad: number, upRad: number): void {
    const { spherical, target } = this;
    spherical.setFromVector3(this.scratch.copy(this.camera.position).sub(target));
    spherical.theta -= rightRad;
    spherical.phi = Math.min(Math.PI - POLE_RAD, Math.max(POLE_RAD, spherical.phi + upRad));
    this.camera.position.setFromSpherical(spherical).add(target);
    this.controls.update();
    this.onChange?.();
  }

  zoom(factor: number): void {
    const offset = this.scratch.copy(this.camera.position).sub(this.target);
    const distance = Math.min(FARTHEST_M, Math.max(NEAREST_M, offset.length() * factor));
    this.camera.position.copy(this.target).addScaledVector(offset.normalize(), distance);
    this.controls.update();
    this.onChange?.();
  }

  /** The named side that lies most in this direction of Patient. */
  sideIn(direction: Vec3): Side {
    const way = this.scratch.set(...this.frames.directionToRenderer(direction));
    const share = (side: Side): number =>
      this.forward.set(...towards(SIDES[side], this.facing)).dot(way);
    const [first, ...others] = Object.keys(SIDES) as [Side, ...Side[]];
    return others.reduce((best, side) => (share(side) > share(best) ? side : best), first);
  }

  /** Right and up of the screen, in Patient. */
  screenAxes(): { readonly right: Vec3; readonly up: Vec3 } {
    const m = this.camera.matrixWorld.elements;
    return {
      right: this.frames.directionToPatient(m[0], m[1], m[2]),
      up: this.frames.directionToPatient(m[4], m[5], m[6]),
    };
  }

  /** Cosine between a direction of Patient and that towards the viewer. */
  towardsViewer(direction: Vec3): number {
    this.camera.getWorldDirection(this.forward);
    this.scratch.set(direction[0], direction[1], direction[2]).transformDirection(this.patient);
    return -this.scratch.dot(this.forward);
  }

  dispose(): void {
    this.controls.dispose();
  }
}

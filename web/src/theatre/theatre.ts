// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The operating theatre's 3-D view. It draws the latest snapshot when something changed, predicts
// nothing, and allocates nothing per frame. All in it but lights and camera is in mm of the Patient
// frame, under one group that carries the conversion (frames/).
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { towards, type FaceNames, type FrameMap } from "../frames";
import type { SnapshotMessage, Vec3 } from "../protocol";
import { backdrop } from "./backdrop";
import { BoneNames } from "./bone_names";
import type { CaseScene } from "./case_scene";
import { ContactMarker } from "./contact_marker";
import {
  alignShaft,
  screwDriver,
  screwGeometry,
  wireDriver,
  wireGeometry,
  type ScrewShape,
} from "./instruments";
import { studioLight, type StudioLight } from "./light";
import { metalMaterial } from "./materials";
import { OrientationCube } from "./orientation_cube";
import { DrawingPace, SOFTWARE_LEVEL, type Drawing } from "./drawing_pace_model";
import { looksDifferent } from "./snapshot_look_model";

export const VIEWS = ["dorsal", "radial", "volar", "ulnar", "wire"] as const;
export type ViewId = (typeof VIEWS)[number];

/** The sides of the forearm as it is held, as for the C-arm: Dorsal looks along the beam of PA. */
const SIDES = { dorsal: "Dorsal", radial: "Radial", volar: "Volar", ulnar: "Ulnar" } as const;
const FIELD_OF_VIEW_DEG = 26;
const DISTANCE_M = 0.225;
const CUBE_PX = 88;
/** A preset is left once the sight turns by more than this, or the wire's tip goes beside it [m]. */
const SAME_SIGHT_COSINE = Math.cos((1.5 * Math.PI) / 180);
const SAME_TIP_M = 0.002;
/** A driver that comes towards the viewer more steeply than this would hide what it points at. */
const HIDE_DRIVER_COSINE = 0.25;

/** Whether WebGL runs on the processor: then a simple drawing from the start. */
function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  if (gl === null || names === null || names === undefined) return false;
  const name = String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export class Theatre {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.01, 3);
  private readonly controls: OrbitControls;
  private readonly light: StudioLight;
  private readonly patient = new THREE.Group();
  private readonly wire = new THREE.Mesh(wireGeometry(), metalMaterial());
  private readonly driver = wireDriver();
  private readonly handDriver = screwDriver();
  private readonly screw = new THREE.Mesh(
    new THREE.BufferGeometry(),
    metalMaterial("#9fb3c4", 0.3),
  );
  private readonly marker = new ContactMarker();
  private readonly cube: OrientationCube;
  private readonly names: BoneNames;
  private readonly caster = new THREE.Raycaster();
  private readonly pointer = new THREE.Vector2();
  private readonly hits: THREE.Intersection[] = [];
  private readonly home = new THREE.Vector3();
  private readonly scratch = new THREE.Vector3();
  private readonly back = new THREE.Vector3();
  private readonly screwTip: [number, number, number] = [0, 0, 0];
  private readonly shaft: [number, number, number] = [0, 0, 1];
  private width = 1;
  private height = 1;
  private stale = true;
  private screwKey = "";
  private readonly pace: DrawingPace;
  private drawing: Drawing;
  /** More shows nothing more. */
  private readonly finestPixelRatio: number;
  private shown: SnapshotMessage | undefined;
  /** The preset that is still looked from, and its direction towards the viewer. */
  private view: ViewId | undefined;
  private readonly viewedFrom = new THREE.Vector3();
  /** The camera or, along it, the wire has left the preset. */
  onViewLeft: (() => void) | undefined;
  private drawn: SnapshotMessage | undefined;
  private readonly observer: ResizeObserver;

  constructor(
    private readonly host: HTMLElement,
    private readonly bones: CaseScene,
    private readonly frames: FrameMap,
    private readonly facing: FaceNames,
  ) {
    const software = drawsInSoftware();
    this.pace = new DrawingPace(software ? SOFTWARE_LEVEL : 0);
    this.drawing = this.pace.drawing;
    // Without antialiasing a still picture is drawn larger than it is shown.
    this.finestPixelRatio = Math.max(software ? 2 : 1, window.devicePixelRatio);
    this.renderer = new THREE.WebGLRenderer({
      antialias: !software,
      powerPreference: "high-performance",
    });
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.renderer.setPixelRatio(this.pixelRatio());
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 0.9;
    this.light = studioLight(this.renderer, this.scene);
    this.light.setShadowPixels(this.drawing.shadowPixels);
    this.cube = new OrientationCube(facing);
    this.names = new BoneNames(bones.bones);
    this.names.canvas.hidden = true;
    this.build();
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.mouseButtons = { LEFT: null, MIDDLE: THREE.MOUSE.PAN, RIGHT: THREE.MOUSE.ROTATE };
    this.controls.touches = { ONE: null, TWO: THREE.TOUCH.DOLLY_ROTATE };
    this.controls.minDistance = 0.05;
    this.controls.maxDistance = 0.8;
    this.controls.zoomSpeed = 0.8;
    this.controls.addEventListener("change", () => {
      this.stale = true;
    });
    // A lost context comes back empty.
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.stale = true;
    });
    this.lookFrom("dorsal");
    host.append(this.canvas, this.names.canvas);
    this.observer = new ResizeObserver(() => {
      this.resize();
    });
    this.observer.observe(host);
    this.resize();
  }

  private build(): void {
    this.patient.matrixAutoUpdate = false;
    this.patient.matrix.fromArray([...this.frames.matrix]);
    this.patient.add(this.bones.root, this.wire, this.driver, this.handDriver, this.screw);
    this.patient.add(this.marker.group);
    this.wire.castShadow = true;
    for (const object of [this.wire, this.driver, this.handDriver, this.screw])
      object.visible = false;
    this.scene.add(backdrop(), this.patient);
    this.scene.updateMatrixWorld(true);
    const box = new THREE.Box3();
    for (const bone of this.bones.bones) {
      if (bone.name.startsWith("scaphoid") || bone.name === "lunate") box.expandByObject(bone);
    }
    if (box.isEmpty()) box.setFromObject(this.bones.root);
    box.getCenter(this.home);
  }

  /** Centre of the scaphoid and lunate in Patient [mm]: where the hand begins. */
  startPointMm(): Vec3 {
    return this.frames.pointToPatient(this.home.x, this.home.y, this.home.z);
  }

  show(snapshot: SnapshotMessage): void {
    this.shown = snapshot;
    if (this.drawn === undefined || looksDifferent(this.drawn, snapshot)) this.stale = true;
  }

  /** Draws the screw with this shape from now on. */
  setScrewShape(shape: ScrewShape): void {
    const key = `${shape.lengthMm} ${shape.tipDiameterMm} ${shape.tailDiameterMm}`;
    if (key === this.screwKey) return;
    this.screwKey = key;
    this.screw.geometry.dispose();
    this.screw.geometry = screwGeometry(shape);
    this.stale = true;
  }

  /** @param opacity 0 none, 1 as on the patient. */
  setSkin(opacity: number): void {
    const { skin, skinDepth } = this.bones;
    if (skin === undefined || skinDepth === undefined) return;
    skin.visible = skinDepth.visible = opacity > 0;
    const uniform = skin.material.uniforms["opacity"];
    if (uniform !== undefined) uniform.value = opacity;
    this.stale = true;
  }

  get namesShown(): boolean {
    return !this.names.canvas.hidden;
  }

  showNames(on: boolean): void {
    this.names.canvas.hidden = !on;
    this.stale = true;
  }

  lookFrom(view: ViewId): void {
    const target = this.controls?.target ?? this.home;
    target.copy(this.home);
    const at = this.camera.position;
    if (view === "wire") {
      if (this.shown === undefined) return;
      at.set(...this.frames.directionToRenderer(this.shown.shaft));
      target.set(...this.shown.tip_mm).applyMatrix4(this.patient.matrix);
    } else {
      at.set(...towards(SIDES[view], this.facing));
    }
    at.normalize()
      .multiplyScalar(view === "wire" ? 0.16 : DISTANCE_M)
      .add(target);
    this.camera.lookAt(target);
    this.controls?.update();
    this.view = view;
    this.viewedFrom.copy(at).sub(target).normalize();
    this.stale = true;
  }

  private watchView(): void {
    if (this.view === undefined || this.holdsView(this.view)) return;
    this.view = undefined;
    this.onViewLeft?.();
  }

  private holdsView(view: ViewId): boolean {
    const { target } = this.controls;
    this.scratch.copy(this.camera.position).sub(target).normalize();
    if (this.scratch.dot(this.viewedFrom) < SAME_SIGHT_COSINE) return false;
    if (view !== "wire" || this.shown === undefined) return true;
    const { shaft, tip_mm } = this.shown;
    this.scratch.set(shaft[0], shaft[1], shaft[2]).transformDirection(this.patient.matrix);
    if (this.scratch.dot(this.viewedFrom) < SAME_SIGHT_COSINE) return false;
    this.scratch.set(tip_mm[0], tip_mm[1], tip_mm[2]).applyMatrix4(this.patient.matrix).sub(target);
    this.scratch.addScaledVector(this.viewedFrom, -this.scratch.dot(this.viewedFrom));
    return this.scratch.length() < SAME_TIP_M;
  }

  /** Turns the view about what it looks at [rad]. */
  orbit(rightRad: number, upRad: number): void {
    const offset = this.scratch.copy(this.camera.position).sub(this.controls.target);
    const spherical = new THREE.Spherical().setFromVector3(offset);
    spherical.theta -= rightRad;
    spherical.phi = Math.min(Math.PI - 0.05, Math.max(0.05, spherical.phi + upRad));
    this.camera.position.setFromSpherical(spherical).add(this.controls.target);
    this.controls.update();
    this.stale = true;
  }

  zoom(factor: number): void {
    const offset = this.scratch.copy(this.camera.position).sub(this.controls.target);
    const distance = Math.min(0.8, Math.max(0.05, offset.length() * factor));
    this.camera.position.copy(this.controls.target).addScaledVector(offset.normalize(), distance);
    this.controls.update();
    this.stale = true;
  }

  /** The point of a bone under the pointer, in Patient [mm]. */
  bonePointAt(clientX: number, clientY: number): Vec3 | undefined {
    this.aim(clientX, clientY);
    this.hits.length = 0;
    this.caster.intersectObjects(this.bones.bones as THREE.Mesh[], false, this.hits);
    const hit = this.hits[0]?.point;
    return hit === undefined ? undefined : this.frames.pointToPatient(hit.x, hit.y, hit.z);
  }

  /** The point under the pointer at the depth of `nearMm`, in Patient [mm]. */
  planePointAt(clientX: number, clientY: number, nearMm: Vec3): Vec3 {
    this.aim(clientX, clientY);
    this.camera.getWorldDirection(this.back);
    this.scratch.set(...nearMm).applyMatrix4(this.patient.matrix);
    const depth = this.scratch.sub(this.camera.position).dot(this.back);
    const { direction, origin } = this.caster.ray;
    const along = depth / direction.dot(this.back);
    const point = this.scratch.copy(origin).addScaledVector(direction, along);
    return this.frames.pointToPatient(point.x, point.y, point.z);
  }

  /** The bone's point on the line of sight through `pointMm`, in Patient [mm]. */
  bonePointBehind(pointMm: Vec3): Vec3 | undefined {
    this.scratch
      .set(...pointMm)
      .applyMatrix4(this.patient.matrix)
      .project(this.camera);
    const rect = this.canvas.getBoundingClientRect();
    return this.bonePointAt(
      rect.left + (0.5 + 0.5 * this.scratch.x) * rect.width,
      rect.top + (0.5 - 0.5 * this.scratch.y) * rect.height,
    );
  }

  /** Right and up of the screen, in Patient. */
  screenAxes(): { readonly right: Vec3; readonly up: Vec3 } {
    const m = this.camera.matrixWorld.elements;
    return {
      right: this.frames.directionToPatient(m[0], m[1], m[2]),
      up: this.frames.directionToPatient(m[4], m[5], m[6]),
    };
  }

  /** Where a point of Patient [mm] is on the page [CSS px]. */
  pagePoint(pointMm: Vec3): { readonly x: number; readonly y: number } {
    this.scratch
      .set(...pointMm)
      .applyMatrix4(this.patient.matrix)
      .project(this.camera);
    const rect = this.canvas.getBoundingClientRect();
    return {
      x: rect.left + (0.5 + 0.5 * this.scratch.x) * rect.width,
      y: rect.top + (0.5 - 0.5 * this.scratch.y) * rect.height,
    };
  }

  /** Draws if anything changed since the last time. */
  draw(): void {
    if (this.width < 2 || this.height < 2) return;
    const now = performance.now();
    if (this.stale) this.pace.moves(now);
    else if (!this.pace.rests(now)) return;
    this.drawAs(this.pace.drawing);
    this.stale = false;
    this.drawn = this.shown;
    this.watchView();
    this.pose();
    this.light.follow(this.camera, this.controls.target);
    this.renderer.setViewport(0, 0, this.width, this.height);
    this.renderer.render(this.scene, this.camera);
    this.cube.draw(this.renderer, this.camera, 8, 8, CUBE_PX);
    if (!this.names.canvas.hidden) {
      this.names.draw(this.camera, this.patient.matrix, this.width, this.height);
    }
  }

  /** On a machine that cannot keep up: coarser shadows, none, fewer pixels. */
  private drawAs(drawing: Drawing): void {
    const before = this.drawing;
    this.drawing = drawing;
    if (drawing.shadowPixels !== before.shadowPixels)
      this.light.setShadowPixels(drawing.shadowPixels);
    if (this.pixelRatio() === this.renderer.getPixelRatio()) return;
    this.renderer.setPixelRatio(this.pixelRatio());
    this.resize();
  }

  private pixelRatio(): number {
    return Math.min(this.finestPixelRatio, this.drawing.pixelRatio);
  }

  dispose(): void {
    this.observer.disconnect();
    this.controls.dispose();
    this.light.dispose();
    this.cube.dispose();
    this.scene.traverse((node) => {
      if (node instanceof THREE.Mesh) (node as THREE.Mesh).geometry.dispose();
    });
    this.renderer.dispose();
    this.canvas.remove();
    this.names.canvas.remove();
  }

  private pose(): void {
    const s = this.shown;
    if (s === undefined) return;
    const inBone = s.wire_engaged;
    const hasScrew = s.screw_index >= 0;
    this.wire.visible = s.instrument !== "none";
    if (inBone) {
      this.setShaft(s.wire_direction, -1);
      alignShaft(this.wire, s.wire_tip_mm, this.shaft);
    } else {
      alignShaft(this.wire, s.tip_mm, s.shaft);
    }
    this.driver.visible = s.instrument === "guide_wire" && !this.comesAtViewer(s.shaft);
    this.driver.position.copy(this.wire.position);
    this.driver.quaternion.copy(this.wire.quaternion);
    this.screw.visible = hasScrew;
    this.handDriver.visible = s.instrument === "screw_driver" && !this.comesAtViewer(s.shaft);
    if (hasScrew) {
      for (let i = 0; i < 3; ++i) {
        this.screwTip[i] =
          (s.wire_entry_mm[i] ?? 0) + s.screw_advance_mm * (s.wire_direction[i] ?? 0);
      }
      this.setShaft(s.wire_direction, -1);
      alignShaft(this.screw, this.screwTip, this.shaft);
      this.handDriver.quaternion.copy(this.screw.quaternion);
      this.handDriver.position
        .set(this.shaft[0], this.shaft[1], this.shaft[2])
        .multiplyScalar(s.screw_length_mm)
        .add(this.screw.position);
    }
    if (s.touching) this.marker.show(s.tip_mm, s.contact_normal, s.force_n);
    else this.marker.hide();
  }

  private setShaft(direction: Vec3, sign: number): void {
    for (let i = 0; i < 3; ++i) this.shaft[i] = sign * (direction[i] ?? 0);
  }

  private comesAtViewer(shaft: Vec3): boolean {
    this.camera.getWorldDirection(this.back);
    const direction = this.scratch.set(shaft[0], shaft[1], shaft[2]);
    direction.transformDirection(this.patient.matrix);
    // `back` is the way the camera looks.
    return -direction.dot(this.back) > HIDE_DRIVER_COSINE;
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

  private resize(): void {
    this.width = this.host.clientWidth;
    this.height = this.host.clientHeight;
    if (this.width < 2 || this.height < 2) return;
    this.renderer.setSize(this.width, this.height, false);
    this.names.resize(this.width, this.height, this.renderer.getPixelRatio());
    this.camera.aspect = this.width / this.height;
    this.camera.updateProjectionMatrix();
    this.stale = true;
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A headset of WebXR: the wrist on a hand table before its wearer, the C-arm's monitor and the words beside
// it, a controller as the instrument.
import * as THREE from "three";
import { drawPicture } from "../c_arm";
import type { FrameMap } from "../frames";
import type { CArmPicture, Vec3 } from "../protocol";
import type { WornStage } from "../theatre";
import type { ControllerState } from "./controller_model";
import { HeadsetHand, type Controller, type HeadsetRoom } from "./headset_hand";
import { before, rendererFromRoom, type Placement } from "./wrist_placement";
import { Plate } from "./plate";
import { REACH_M } from "./tool_in_hand";
import { WordPlate, type Words } from "./word_plate";

const MONITOR_M = 0.34;
const MONITOR_PIXELS = 768;
const WORDS_M = 0.46;
/** From the middle of the wrist, to the side, up and away [m]. */
const MONITOR_AT = new THREE.Vector3(-0.3, 0.2, -0.2);
const WORDS_AT = new THREE.Vector3(0.34, 0.2, -0.18);
const TABLE_M = 0.3;
/** A carpus is some 35 mm thick with its skin; the table is below it. */
const TABLE_BELOW_M = 0.03;
const WORDS_EVERY_MS = 100;

export interface HeadsetHandlers extends HeadsetRoom {
  /** Why it is not put on; undefined: it is. */
  whyNot(): string | undefined;
  stage(): WornStage;
  words(): Words;
  /** The newest picture; undefined before the first. */
  picture(): CArmPicture | undefined;
  /** A picture was drawn: what goes on by itself goes on with it. */
  beat(nowMs: number): void;
  /** It was put on, or taken off. */
  worn(on: boolean): void;
  say(text: string): void;
}

/** What its wearer sees, and where. */
export interface ShownInRoom {
  readonly text: string;
  readonly enlarged: number;
  /** Where a point of Patient [mm] lies in the room [m]. */
  roomPoint(mm: Vec3): Vec3;
}

/** Whether this browser has a headset; asked once. */
export async function headsetIsThere(): Promise<boolean> {
  try {
    return (await navigator.xr?.isSessionSupported("immersive-vr")) ?? false;
  } catch {
    return false; // a page that may not ask has none
  }
}

export class Headset {
  private worn: Worn | undefined;
  private isAsking = false;

  constructor(
    private readonly handlers: HeadsetHandlers,
    private readonly frames: FrameMap,
  ) {}

  /** Puts it on, or takes it off. To be called by a press: browsers demand it. */
  async toggle(): Promise<void> {
    if (this.worn !== undefined) return this.worn.session.end();
    if (this.isAsking) return;
    const why = this.handlers.whyNot();
    if (why !== undefined) {
      this.handlers.say(why);
      return;
    }
    this.isAsking = true;
    try {
      const session = await navigator.xr?.requestSession("immersive-vr", {
        optionalFeatures: ["local-floor"],
      });
      if (session === undefined) throw new Error("this browser has none");
      await this.wear(session);
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      this.handlers.say(`The headset cannot be used: ${why}`);
    } finally {
      this.isAsking = false;
    }
  }

  private async wear(session: XRSession): Promise<void> {
    const stage = this.handlers.stage();
    const worn = new Worn(session, stage, this.handlers, this.frames);
    this.worn = worn;
    session.addEventListener("end", () => {
      worn.dispose();
      this.worn = undefined;
      this.handlers.worn(false);
    });
    try {
      await worn.begin();
      this.handlers.worn(true);
    } catch (error) {
      await session.end();
      throw error;
    }
  }

  get shown(): ShownInRoom | undefined {
    return this.worn?.shown;
  }

  dispose(): void {
    void this.worn?.session.end();
  }
}

class Worn {
  private readonly hand: HeadsetHand;
  private readonly furniture = new THREE.Group();
  private readonly monitor = new Plate(MONITOR_M, [MONITOR_PIXELS, MONITOR_PIXELS]);
  private readonly words = new WordPlate(WORDS_M);
  private readonly rays: readonly [THREE.Line, THREE.Line] = [pointer(), pointer()];
  private readonly room = new THREE.Matrix4();
  private placement: Placement | undefined;
  private picture: CArmPicture | undefined;
  private lastMs = 0;
  private wordsMs = -Infinity;

  constructor(
    readonly session: XRSession,
    private readonly stage: WornStage,
    private readonly handlers: HeadsetHandlers,
    private readonly frames: FrameMap,
  ) {
    this.hand = new HeadsetHand(handlers, frames);
    this.furniture.add(table(), this.monitor.mesh, this.words.mesh);
    this.monitor.mesh.position.copy(MONITOR_AT);
    this.monitor.mesh.rotation.set(-0.25, 0.45, 0, "YXZ");
    this.words.mesh.position.copy(WORDS_AT);
    this.words.mesh.rotation.set(-0.25, -0.5, 0, "YXZ");
    this.furniture.visible = false;
    stage.rig.add(this.furniture, ...this.rays);
    drawPicture(this.monitor.canvas, undefined, false, undefined);
    // Whoever opens the headset's own menu has let go.
    session.addEventListener("visibilitychange", () => {
      if (session.visibilityState !== "visible") this.hand.rest();
    });
  }

  get shown(): ShownInRoom | undefined {
    if (this.placement === undefined) return undefined;
    return {
      text: this.words.text,
      enlarged: this.placement.enlarged,
      roomPoint: (mm) => {
        const at = new THREE.Vector3(...this.frames.pointToRenderer(mm));
        return at.applyMatrix4(this.room.clone().invert()).toArray();
      },
    };
  }

  async begin(): Promise<void> {
    const { renderer } = this.stage;
    renderer.xr.enabled = true;
    renderer.xr.setReferenceSpaceType(await this.bestSpace());
    await renderer.xr.setSession(this.session);
    renderer.setAnimationLoop((nowMs, frame?: XRFrame) => {
      if (frame !== undefined) this.draw(nowMs, frame);
    });
  }

  dispose(): void {
    const { renderer } = this.stage;
    this.hand.rest();
    renderer.setAnimationLoop(null);
    renderer.xr.enabled = false;
    this.stage.end();
    this.monitor.dispose();
    this.words.dispose();
    this.furniture.traverse(disposeOf);
    this.rays.forEach(disposeOf);
  }

  private async bestSpace(): Promise<XRReferenceSpaceType> {
    try {
      await this.session.requestReferenceSpace("local-floor");
      return "local-floor";
    } catch {
      return "local";
    }
  }

  private draw(nowMs: number, frame: XRFrame): void {
    const space = this.stage.renderer.xr.getReferenceSpace();
    const viewer = space === null ? undefined : frame.getViewerPose(space);
    if (space === null || viewer === undefined) return;
    this.placement ??= this.seat(viewer.transform);
    const isSeen = this.session.visibilityState === "visible";
    const instrument = isSeen ? this.controller(frame, space, "right") : undefined;
    const other = isSeen ? this.controller(frame, space, "left") : undefined;
    this.room.copy(rendererFromRoom(this.placement, this.stage.home));
    this.hand.frame(instrument, other, this.placement, this.room, (nowMs - this.lastMs) / 1000);
    this.lastMs = nowMs;
    this.room.copy(rendererFromRoom(this.placement, this.stage.home));
    this.stage.setRoom(this.room);
    this.furnish(this.placement);
    this.showRay(0, instrument);
    this.showRay(1, other);
    this.showScreens(nowMs);
    this.handlers.beat(nowMs);
    this.stage.draw();
  }

  private seat(eyes: XRRigidTransform): Placement {
    const pose = new THREE.Matrix4().fromArray(eyes.matrix);
    const forward = new THREE.Vector3(0, 0, -1).transformDirection(pose);
    return before(new THREE.Vector3().setFromMatrixPosition(pose), forward);
  }

  private controller(
    frame: XRFrame,
    space: XRReferenceSpace,
    handedness: XRHandedness,
  ): Controller | undefined {
    for (const source of this.session.inputSources) {
      const { gamepad } = source;
      if (source.handedness !== handedness || gamepad === undefined) continue;
      if (gamepad === null || gamepad.mapping !== "xr-standard") continue;
      const pose = frame.getPose(source.targetRaySpace, space);
      if (pose === undefined) continue;
      return { ray: new THREE.Matrix4().fromArray(pose.transform.matrix), state: copy(gamepad) };
    }
    return undefined;
  }

  private furnish({ place, yawRad, enlarged }: Placement): void {
    this.furniture.visible = true;
    this.furniture.position.copy(place);
    this.furniture.rotation.set(0, yawRad, 0);
    const [tableMesh] = this.furniture.children;
    if (tableMesh !== undefined) tableMesh.position.y = -TABLE_BELOW_M * enlarged;
  }

  private showRay(at: 0 | 1, controller: Controller | undefined): void {
    const ray = this.rays[at];
    ray.visible = controller !== undefined;
    if (controller !== undefined) ray.matrix.copy(controller.ray);
  }

  private showScreens(nowMs: number): void {
    const picture = this.handlers.picture();
    if (picture !== this.picture) {
      this.picture = picture;
      drawPicture(this.monitor.canvas, picture, false, undefined);
      this.monitor.changed();
    }
    if (nowMs - this.wordsMs < WORDS_EVERY_MS) return;
    this.wordsMs = nowMs;
    this.words.show(this.handlers.words());
  }
}

/** The browser's own object changes under the reader. */
function copy({ axes, buttons }: Gamepad): ControllerState {
  return {
    axes: [...axes],
    buttons: buttons.map(({ value, pressed }) => ({ value, pressed })),
  };
}

/** From the hand to where the tip is. */
function pointer(): THREE.Line {
  const ends = [new THREE.Vector3(), new THREE.Vector3(0, 0, -REACH_M)];
  const line = new THREE.Line(
    new THREE.BufferGeometry().setFromPoints(ends),
    new THREE.LineBasicMaterial({ color: "#6c7f88" }),
  );
  line.matrixAutoUpdate = false;
  line.visible = false;
  return line;
}

function table(): THREE.Mesh {
  const mesh = new THREE.Mesh(
    new THREE.CylinderGeometry(TABLE_M, TABLE_M, 0.01, 64),
    new THREE.MeshStandardMaterial({ color: "#1f4a57", roughness: 0.95 }),
  );
  mesh.receiveShadow = true;
  return mesh;
}

function disposeOf(node: THREE.Object3D): void {
  if (!(node instanceof THREE.Mesh || node instanceof THREE.Line)) return;
  const { geometry, material } = node as THREE.Mesh;
  geometry.dispose();
  for (const one of Array.isArray(material) ? material : [material]) one.dispose();
}

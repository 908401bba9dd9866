// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The operating theatre's 3-D view. It draws the latest snapshot when something changed, predicts
// nothing, and allocates nothing per frame. All in it but lights and camera is in mm of the Patient
// frame, under one group that carries the conversion (frames/).
import * as THREE from "three";
import { make } from "../dom";
import type { Look } from "../appearance";
import type { FaceNames, FrameMap } from "../frames";
import type {
  BodyPose,
  Ideal,
  Instrument,
  SkinMessage,
  SnapshotMessage,
  Track,
  Vec3,
} from "../protocol";
import { AppliedLook } from "./applied_look";
import { backdrop } from "./backdrop";
import { Beam } from "./beam";
import { BeamShown, roomAngles, towardsSource } from "./beam_model";
import { BoneNames } from "./bone_names";
import { BoneRays } from "./bone_rays";
import type { CaseScene } from "./case_scene";
import { CutBones } from "./cut_bones";
import { cutPlane, type Cut } from "./cut_plane_model";
import { DrawingSurface } from "./drawing_surface";
import { Ghost } from "./ghost";
import { studioLight, type StudioLight } from "./light";
import { middleOfBones } from "./middle_of";
import { MovingBones } from "./moving_bones";
import { OrientationCube } from "./orientation_cube";
import { PointedAt, type PagePoint } from "./pointed_at";
import { ShownInstruments } from "./shown_instruments";
import { Sight, type ToolLine, type ViewId } from "./sight";
import { SightMark } from "./sight_mark";
import { SkinWork } from "./skin_work";
import { STRUCTURES_NOTE } from "./structure_model";
import { looksDifferent } from "./snapshot_look_model";
import { WornStage } from "./worn_stage";

const CUBE_PX = 88;
/** In a lower picture the cube would stand before the hand. */
const CUBE_FROM_PX = 240;
/** What faces the viewer by less is seen from its edge, or not at all. */
const SEEN_COSINE = 0.5;
/** With two eyes one looks past what holds an instrument. */
const HOLDERS_ARE_SEEN = (): number => 0;

export class Theatre {
  private readonly surface: DrawingSurface;
  private readonly scene = new THREE.Scene();
  private readonly light: StudioLight;
  private readonly patient = new THREE.Group();
  private readonly bones: MovingBones;
  private readonly instruments = new ShownInstruments();
  private readonly beam = new Beam();
  private readonly beamShown = new BeamShown();
  private readonly ghost = new Ghost();
  private readonly cutBones: CutBones;
  private readonly look: AppliedLook;
  private readonly skinWork: SkinWork;
  private cut: Cut = "off";
  private ideal: Ideal | null = null;
  private readonly scratch = {
    plane: new THREE.Plane(),
    sight: new THREE.Vector3(),
    entry: new THREE.Vector3(),
    axis: new THREE.Vector3(),
  };
  private target: readonly string[] = [];
  private readonly radialIsRight: boolean;
  private readonly cube: OrientationCube;
  private readonly names: BoneNames;
  private readonly structuresNote = make("p.structures-note", {}, STRUCTURES_NOTE);
  private readonly sightMark = new SightMark();
  private readonly sight: Sight;
  private readonly backdrop = backdrop();
  /** While a headset is worn it draws, and the page's canvas rests. */
  private worn: WornStage | undefined;
  private readonly rays: BoneRays;
  private readonly pointed: PointedAt;
  private readonly home: THREE.Vector3;
  private stale = true;
  private onlySkin = false;
  private activeHand: 0 | 1 = 0;
  /** The beam as it was drawn; empty for none. */
  private beamDrawn = "";
  private shown: SnapshotMessage | undefined;
  private drawn: SnapshotMessage | undefined;
  private readonly towardsViewer = (direction: Vec3): number => this.sight.towardsViewer(direction);

  constructor(
    host: HTMLElement,
    private readonly caseScene: CaseScene,
    private readonly frames: FrameMap,
    facing: FaceNames,
  ) {
    this.surface = new DrawingSurface(host);
    this.light = studioLight(this.surface.renderer, this.scene);
    this.cube = new OrientationCube(facing);
    this.bones = new MovingBones(caseScene);
    this.cutBones = new CutBones(caseScene.bones);
    this.look = new AppliedLook(caseScene);
    this.names = new BoneNames(caseScene.bones, caseScene.structures);
    this.names.canvas.hidden = true;
    this.patient.matrixAutoUpdate = false;
    this.patient.matrix.fromArray([...frames.matrix]);
    this.skinWork = new SkinWork((at) => caseScene.skin?.nearest(at) ?? { at, out: [0, 0, 1] });
    this.patient.add(caseScene.root, this.instruments.group, this.skinWork.group);
    this.scene.add(this.backdrop, this.patient, this.beam.group);
    this.radialIsRight = facing.right === "Radial";
    this.scene.updateMatrixWorld(true);
    this.home = middleOf(caseScene, []);
    const { matrix } = this.patient;
    this.sight = new Sight(this.canvas, this.home, matrix, frames, facing);
    const { skin } = caseScene;
    skin?.layCreases(frames.matrix);
    this.rays = new BoneRays(caseScene.bones, skin && (() => skin.hittable()));
    this.pointed = new PointedAt(this.canvas, this.sight.camera, this.rays, matrix, frames);
    this.sight.onChange = () => {
      this.stale = true;
    };
    this.surface.start({
      onSize: (width, height, ratio) => {
        this.names.resize(width, height, ratio);
        this.sight.setAspect(width / height);
        this.stale = true;
      },
      onLost: () => {
        this.light.mirrorAnew();
        this.stale = true;
      },
      onShadowPixels: (side) => {
        this.light.setShadowPixels(side);
      },
    });
    this.structuresNote.hidden = true;
    host.append(this.names.canvas, this.sightMark.element, this.structuresNote);
  }

  get canvas(): HTMLCanvasElement {
    return this.surface.canvas;
  }

  /** The camera or, along it, the wire has left the preset. */
  set onViewLeft(told: () => void) {
    this.sight.onViewLeft = told;
  }

  /** Middle of what is operated on, in Patient [mm]. */
  middleMm(): Vec3 {
    return this.frames.pointToPatient(this.home.x, this.home.y, this.home.z);
  }

  private get tool(): ToolLine | undefined {
    const held = this.shown?.hands[this.activeHand].item ?? -1;
    return this.shown?.items.find((item) => item.item === held);
  }

  show(snapshot: SnapshotMessage): void {
    this.shown = snapshot;
    if (this.drawn === undefined || looksDifferent(this.drawn, snapshot)) this.stale = true;
  }

  /** Whether the C-arm's beam is drawn while it rests, too. */
  wishBeam(on: boolean): void {
    this.beamShown.isWished = on;
  }

  get beamIsDrawn(): boolean {
    return this.beamDrawn !== "";
  }

  /** Draws the beam where it is now, or none. */
  private showBeam(nowMs: number): void {
    if (this.shown === undefined) return;
    const angles = roomAngles(this.shown.c_arm, this.shown.wrist.pronation_deg);
    const wanted = this.beamShown.update(angles, nowMs);
    const key = wanted ? `${angles.rotationDeg} ${angles.tiltDeg}` : "";
    if (key === this.beamDrawn) return;
    this.beamDrawn = key;
    this.stale = true;
    if (!wanted) this.beam.hide();
    else {
      const source = towardsSource(angles, this.radialIsRight);
      this.beam.show(middleOf(this.caseScene, this.target), source);
    }
  }

  /** What the snapshots' items are drawn from. */
  setInstruments(instruments: readonly Instrument[]): void {
    this.instruments.setInstruments(instruments);
    this.stale = true;
  }

  /** The views look at the middle of these bones, where they are now. */
  setTarget(names: readonly string[]): void {
    this.target = names;
    this.beamShown.forget();
    this.home.copy(middleOf(this.caseScene, names));
    this.sight.lookAgain(this.tool);
    this.stale = true;
  }

  /** Puts a bone where it is now, with its name, its holes and the skin about it. */
  setBonePose(name: string, { quaternion, translation_mm }: BodyPose): void {
    const [w, x, y, z] = quaternion;
    if (this.bones.setPose(name, [x, y, z, w], translation_mm)) this.stale = true;
  }

  /** Which hand's instrument the view along the shaft follows. */
  setActiveHand(hand: 0 | 1): void {
    this.activeHand = hand;
  }

  /** Shows what was drilled out of the bones, all of it at once. */
  setTracks(tracks: readonly Track[]): void {
    if (this.bones.setTracks(tracks)) this.stale = true;
  }

  /** Materials, lamps, bitmaps, facets' edges and hulls. */
  setLook(look: Look): void {
    this.look.apply(look);
    this.light.setLamps(look.lamps);
    this.stale = true;
  }

  /** @param opacity 0 none, 1 as on the patient. */
  setSkin(opacity: number): void {
    this.caseScene.skin?.setOpacity(opacity);
    this.stale = true;
  }

  /** Only what a patient shows: closed skin, no bones, no names; the pointer ends at the skin. */
  showOnlySkin(on: boolean): void {
    this.onlySkin = on;
    const { bones, skin } = this.caseScene;
    // Without skin there would be nothing left to see.
    const closed = on && skin !== undefined;
    for (const bone of bones) bone.visible = !closed;
    if (on) this.showStructures(false);
    skin?.setClosed(closed);
    this.rays.hitsSkin = closed;
    if (closed) this.showNames(false);
    this.stale = true;
  }

  /** What is done to closed skin; undefined: nothing. */
  showSkinWork(message: SkinMessage | undefined): void {
    this.skinWork.show(message, this.shown);
    this.stale = true;
  }

  /** Whether the case has tendons, arteries and nerves. */
  get hasStructures(): boolean {
    return !this.caseScene.structures.isEmpty;
  }

  get structuresShown(): boolean {
    return this.caseScene.structures.group.visible;
  }

  /** Tendons, arteries and nerves, with the words that no scan shows them; never in an assessed operation. */
  showStructures(on: boolean): void {
    this.caseScene.structures.group.visible = on && this.hasStructures && !this.onlySkin;
    this.structuresNote.hidden = !this.structuresShown;
    this.stale = true;
  }

  get namesShown(): boolean {
    return !this.names.canvas.hidden;
  }

  /** Never over closed skin: a patient's bones are not named. */
  showNames(on: boolean): void {
    this.names.canvas.hidden = !on || this.rays.hitsSkin;
    this.stale = true;
  }

  /** The line and the screw to be shown on request; none in an assessed operation. */
  setIdeal(ideal: Ideal | null, instruments: readonly Instrument[]): void {
    this.ideal = ideal;
    this.ghost.set(ideal, instruments);
    this.ghost.group.visible = false;
    this.skinWork.showAids(false);
    this.setCut("off");
  }

  get ghostIsShown(): boolean {
    return this.ghost.group.visible;
  }

  /** Of the planned line and screw; on closed skin of the next portal. */
  showGhost(on: boolean): void {
    this.skinWork.showAids(on);
    this.idealBone()?.add(this.ghost.group);
    this.ghost.group.visible = on;
    this.stale = true;
  }

  get cutIs(): Cut {
    return this.cut;
  }

  setCut(cut: Cut): void {
    this.cut = cut;
    this.stale = true;
  }

  /** The piece in which the ideal line goes in. */
  private idealBone(): THREE.Object3D | undefined {
    return this.caseScene.bones.find((bone) => bone.name === this.ideal?.body);
  }

  /** The plane goes with the camera, and with the bone in which the axis lies. */
  private followCut(): void {
    if (this.cut === "off") return this.cutBones.cut(undefined);
    const { axis, entry, plane, sight } = this.scratch;
    this.sight.camera.getWorldDirection(sight);
    const bone = this.cut === "axis" ? this.idealBone() : undefined;
    if (bone !== undefined && this.ideal !== null) {
      entry.set(...this.ideal.entry_mm).applyMatrix4(bone.matrixWorld);
      axis.set(...this.ideal.direction).transformDirection(bone.matrixWorld);
    } else {
      entry.copy(middleOf(this.caseScene, this.target));
    }
    const found = cutPlane(entry.toArray(), sight.toArray(), bone && axis.toArray());
    if (found === undefined) return this.cutBones.cut(undefined);
    plane.normal.set(...found.normal);
    plane.constant = found.constant;
    this.cutBones.cut(plane);
  }

  /** Whether the pointer's main button, or one finger, turns the view. */
  setDragLooks(on: boolean): void {
    this.sight.setDragLooks(on);
  }

  lookFrom(view: ViewId): void {
    this.sight.lookFrom(view, this.tool);
  }

  /** From where something that faces this way, in Patient, is seen; undefined: from where one looks now. */
  viewOf(facing: Vec3): ViewId | undefined {
    return this.sight.towardsViewer(facing) < SEEN_COSINE ? this.sight.sideIn(facing) : undefined;
  }

  /** Turns the view about what it looks at [rad], and marks the middle for a moment. */
  orbit(rightRad: number, upRad: number): void {
    this.sightMark.show();
    this.sight.orbit(rightRad, upRad);
  }

  zoom(factor: number): void {
    this.sight.zoom(factor);
  }

  /** The point of a bone under the pointer, in Patient [mm]. */
  bonePointAt(clientX: number, clientY: number): Vec3 | undefined {
    return this.pointed.boneAt(clientX, clientY);
  }

  /** The point under the pointer at the depth of `nearMm`, in Patient [mm]. */
  planePointAt(clientX: number, clientY: number, nearMm: Vec3): Vec3 {
    return this.pointed.planeAt(clientX, clientY, nearMm);
  }

  /** The bone's point on the line of sight through `pointMm`, in Patient [mm]. */
  bonePointBehind(pointMm: Vec3): Vec3 | undefined {
    return this.pointed.boneBehind(pointMm);
  }

  /** Right and up of the screen, in Patient. */
  screenAxes(): { readonly right: Vec3; readonly up: Vec3 } {
    return this.sight.screenAxes();
  }

  /** Where a point of Patient [mm] is on the page [CSS px]. */
  pagePoint(pointMm: Vec3): PagePoint {
    return this.pointed.pagePoint(pointMm);
  }

  /** The same scene for a headset, until its end() gives it back to the page. */
  beWorn(): WornStage {
    const { renderer } = this.surface;
    this.worn?.end();
    this.backdrop.visible = false;
    this.light.follow(this.sight.camera, this.home);
    this.worn = new WornStage(renderer, this.scene, this.home, {
      before: () => {
        this.showBeam(performance.now());
        if (this.shown !== undefined) this.instruments.pose(this.shown, HOLDERS_ARE_SEEN);
      },
      end: () => {
        this.worn = undefined;
        this.backdrop.visible = true;
        this.stale = true;
      },
    });
    return this.worn;
  }

  /** Draws if anything changed since the last time. */
  draw(): void {
    if (this.worn !== undefined) return;
    const { renderer } = this.surface;
    this.showBeam(performance.now());
    if (!this.surface.wantsDrawing(this.stale)) return;
    this.stale = false;
    this.drawn = this.shown;
    this.sight.watch(this.tool);
    if (this.shown !== undefined) this.instruments.pose(this.shown, this.towardsViewer);
    this.followCut();
    this.light.follow(this.sight.camera, this.sight.target);
    renderer.render(this.scene, this.sight.camera);
    if (this.surface.height >= CUBE_FROM_PX)
      this.cube.draw(renderer, this.sight.camera, 8, 8, CUBE_PX);
    if (this.namesShown)
      this.names.draw(this.sight.camera, this.surface.width, this.surface.height);
  }

  dispose(): void {
    this.worn?.end();
    this.sight.dispose();
    this.light.dispose();
    this.cube.dispose();
    this.bones.dispose();
    this.instruments.dispose();
    this.ghost.dispose();
    this.skinWork.dispose();
    this.cutBones.dispose();
    this.look.dispose();
    this.scene.traverse((node) => {
      if (node instanceof THREE.Mesh) (node as THREE.Mesh).geometry.dispose();
    });
    this.surface.dispose();
    this.names.canvas.remove();
    this.structuresNote.remove();
    this.sightMark.dispose();
  }
}

/** Middle of the bones of these names, or of all [m]. */
function middleOf({ bones, root }: CaseScene, names: readonly string[]): THREE.Vector3 {
  return (
    middleOfBones(bones, names) ??
    new THREE.Box3().setFromObject(root).getCenter(new THREE.Vector3())
  );
}

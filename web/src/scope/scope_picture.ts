// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws the scope's round picture: the wall of the joint that it is in, and what the other hand holds in it.
import * as THREE from "three";
import { drawsInSoftware, lostPicture } from "../dom";
import type {
  BodyPose,
  ControlledScrew,
  Instrument,
  JointFluid,
  ScopeMessage,
  Vec3,
} from "../protocol";
import { meanGrey, nextExposure } from "./auto_exposure";
import type { JointWall } from "./joint_wall";
import { LooseBodies } from "./loose_bodies";
import { ScopeBackdrop } from "./scope_backdrop";
import { ScopeBeads } from "./scope_beads";
import type { Bead } from "./scope_drill_model";
import { ScopeFilm } from "./scope_film";
import { ScopeFluid } from "./scope_fluid";
import { ScopeFocus } from "./scope_focus";
import {
  lesionUniforms,
  paintOf,
  scuffed,
  setLesions,
  type Lesion,
  type Painted,
} from "./scope_lesions";
import { rodGeometries, rodOf } from "./scope_rod";
import { ScopeScrew } from "./scope_screw";
import { holeUniforms, setHole } from "./screw_hole";
import { depthMaterial, lensUniforms, setWall, wetMaterial } from "./scope_shader";
import type { Rod } from "./scope_tools";
import { TissuePieces, type TissuePiece } from "./tissue_pieces";

export interface ScopeSight {
  readonly eyeMm: Vec3;
  readonly axis: Vec3;
  readonly up: Vec3;
}

/** The lamp's fibres lie beside the lens [mm]. */
const LAMP_UP_MM = 0.9;
const LAMP_RIGHT_MM = 0.35;
/** How often the camera looks at its own picture [ms], and how small [px]. */
const EXPOSED_EVERY_MS = 200;
const EXPOSED_PX = 16;
/** Drawn at most so large across, and less where the machine is slow [device px]. */
const LARGEST_PX = 900;

/** Written anew for each picture. */
const SKIN = new THREE.Vector3();

export class ScopePicture {
  readonly canvas: HTMLCanvasElement;
  /** What is said over it while there is none. */
  readonly lost: HTMLElement;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();
  private readonly lens = lensUniforms();
  private readonly rod: THREE.Mesh;
  private readonly rods = rodGeometries();
  /** Of what makes portals, by instrument. */
  private skinTools: ReadonlyMap<string, THREE.BufferGeometry> = new Map();
  private readonly walls: ReadonlyMap<
    string,
    THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>
  >;
  /** Of the wall that is seen. */
  private readonly depth: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;
  private isDepthLaid = false;
  private readonly lesions = lesionUniforms();
  private wrong: readonly Painted[] = [];
  private scuffs: readonly Painted[] = [];
  private poses: readonly BodyPose[] = [];
  private readonly loose: LooseBodies;
  private readonly beads: ScopeBeads;
  private readonly pieces: TissuePieces;
  /** Whoever wants less motion sees tufts that keep still. */
  private readonly isStill = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  private readonly hole = holeUniforms();
  private readonly screw = new ScopeScrew(this.lens);
  private readonly backdrop = new ScopeBackdrop(this.lens);
  private readonly fluid = new ScopeFluid(this.lens);
  private readonly film = new ScopeFilm(this.lens);
  private readonly focus = new ScopeFocus(this.lens, this.film.mesh);
  private high: Vec3 = [0, 0, 1];
  private readonly small = smallContext();
  /** When light was measured last: at the first picture it is right at once. */
  private exposedMs = -Infinity;

  /** @param onBack  what was drawn is gone, and can be drawn again */
  constructor(
    private readonly all: readonly JointWall[],
    onBack: () => void = () => undefined,
  ) {
    const walls = this.all;
    this.renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(1);
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // the shader does it
    this.renderer.info.autoReset = false; // a picture is drawn in several goes
    this.canvas = this.renderer.domElement;
    this.canvas.className = "scope-picture";
    this.canvas.setAttribute("aria-label", "The arthroscope's picture");
    this.lost = lostPicture(this.canvas, () => {
      this.exposedMs = -Infinity;
      onBack();
    });
    this.walls = new Map(
      walls.map((wall) => [
        wall.joint,
        new THREE.Mesh(wall.geometry, wetMaterial(this.lens, false, this.lesions, this.hole)),
      ]),
    );
    this.depth = new THREE.Mesh(new THREE.BufferGeometry(), depthMaterial(this.lens));
    this.depth.renderOrder = -1;
    this.rod = new THREE.Mesh(this.rods.probe, wetMaterial(this.lens, true));
    this.loose = new LooseBodies(wetMaterial(this.lens, false));
    this.beads = new ScopeBeads(this.lens);
    this.pieces = new TissuePieces(wetMaterial(this.lens, false));
    this.setWalls(false);
    this.scene.add(
      this.backdrop.mesh,
      this.loose.group,
      this.pieces.group,
      this.beads.group,
      this.screw.group,
      this.fluid.mesh,
    );
    for (const mesh of [...this.walls.values(), this.depth, this.rod]) {
      mesh.frustumCulled = false; // the lens is no frustum
      this.scene.add(mesh);
    }
  }

  /** By which what runs or sways is drawn; stands for whoever wants less motion. */
  get nowMs(): number {
    return this.isStill ? 0 : performance.now();
  }

  /** @param fieldDeg  across the picture */
  setField(fieldDeg: number): void {
    this.lens.halfField.value = (fieldDeg * Math.PI) / 360;
  }

  /** Of an exercise: what makes portals comes into view as well. */
  setInstruments(instruments: readonly Instrument[]): void {
    for (const geometry of this.skinTools.values()) geometry.dispose();
    this.skinTools = new Map(
      instruments
        .filter((one) => one.skin_work !== "none")
        .map((one) => [one.id, rodOf(one.parts)]),
    );
  }

  /** @param step  of the camera head's ring, as focus_model.ts has it */
  setFocus(step: number): void {
    this.focus.step = step;
  }

  /** What is wrong in the joints of this exercise. @param bodies  names in the order of the poses */
  setWrong(
    lesions: readonly Lesion[],
    pieces: readonly TissuePiece[],
    bodies: readonly string[],
  ): void {
    this.wrong = paintOf(lesions, this.all, bodies);
    this.scuffs = [];
    this.loose.set(lesions);
    this.pieces.set(pieces, bodies);
    this.beads.setBodies(bodies);
  }

  /** What lies in a bone from the beginning; null: nothing. */
  setScrew(screw: ControlledScrew | null, bodies: readonly string[]): void {
    setHole(this.hole, screw);
    this.setWalls(screw !== null);
    this.screw.set(screw, bodies, this.all);
  }

  /**
   * A processor shades first and asks for depth later: for it, depth laid before is only more to draw. A screw's hole is cut
   * as the wall is shaded, so that no depth may be laid before it.
   */
  private setWalls(hasScrew: boolean): void {
    this.isDepthLaid = !hasScrew && !drawsInSoftware();
    for (const { material } of this.walls.values()) setWall(material, hasScrew, this.isDepthLaid);
  }

  /** Marks of an exercise. */
  setBeads(beads: readonly Bead[]): void {
    this.beads.set(beads);
  }

  /** Fluid between, none: null. @param high  unit, up in the room: there bubbles collect */
  setFluid(fluid: JointFluid | null, high: Vec3): void {
    this.fluid.set(fluid);
    this.high = high;
  }

  /** The bones have moved, or the scope has gone to another joint. */
  lay(joint: string, poses: readonly BodyPose[]): void {
    this.poses = poses;
    this.paint(joint);
    this.beads.lay(poses);
    this.pieces.lay(poses);
    this.screw.lay(poses);
  }

  private paint(joint: string): void {
    setLesions(this.lesions, [...this.scuffs, ...this.wrong], joint, this.poses);
  }

  /**
   * @param joint  id of the one that the scope's portal leads into
   * @param scope  what floats, what was left of what can be taken away, where cartilage was bitten
   * @param skin  the portal that the lens is before; undefined once it is under the skin
   */
  draw(
    joint: string,
    sight: ScopeSight,
    rod: Rod | undefined,
    scope: Pick<ScopeMessage, "loose" | "pieces_left" | "running" | "scuffs">,
    sizePx: number,
    skin: { readonly skinMm: Vec3; readonly inwards: Vec3 } | undefined,
  ): void {
    if (!this.lost.hidden) return; // in the dark no light is measured
    const size = Math.max(64, Math.min(LARGEST_PX, Math.round(sizePx)));
    if (this.canvas.height !== size) this.renderer.setSize(size, size, false); // not so at first, which is no square
    const { eye, axis, up, right, lamp } = this.lens;
    eye.value.set(...sight.eyeMm);
    axis.value.set(...sight.axis);
    up.value.set(...sight.up);
    right.value.crossVectors(axis.value, up.value);
    lamp.value
      .copy(eye.value)
      .addScaledVector(up.value, LAMP_UP_MM)
      .addScaledVector(right.value, LAMP_RIGHT_MM);
    for (const [id, wall] of this.walls) wall.visible = skin === undefined && id === joint;
    const shown = skin === undefined ? this.walls.get(joint) : undefined;
    if (shown !== undefined) this.depth.geometry = shown.geometry;
    this.depth.visible = shown !== undefined && this.isDepthLaid;
    this.backdrop.setOutside(skin?.skinMm, skin?.inwards ?? sight.axis);
    this.loose.group.visible = this.beads.group.visible = skin === undefined;
    this.pieces.group.visible = skin === undefined;
    this.screw.group.visible = skin === undefined;
    this.rod.visible = rod !== undefined;
    this.loose.lay(joint, scope.loose);
    if (scope.scuffs.length !== this.scuffs.length) {
      this.scuffs = scuffed(scope.scuffs, this.all);
      this.paint(joint);
    }
    this.pieces.show(
      joint,
      scope.pieces_left,
      rod?.mouth !== undefined && scope.running.includes(1) ? mouthAt(rod) : undefined,
      sight.eyeMm,
      this.nowMs / 1000,
    );
    if (rod !== undefined) {
      this.rod.geometry = this.skinTools.get(rod.instrument ?? "") ?? this.rods[rod.look];
      this.rod.position.set(...rod.tipMm);
      this.rod.quaternion.copy(turnOf(rod));
      this.rod.updateMatrixWorld();
    }
    this.fluid.lay(
      shown?.geometry.getAttribute("position").array,
      { ...sight, high: this.high, halfFieldRad: this.lens.halfField.value },
      performance.now(),
    );
    this.film.lay(skin !== undefined);
    this.renderer.info.reset();
    this.focus.draw(this.renderer, {
      scene: this.scene,
      camera: this.camera,
      sizePx: size,
      behindMm: skin === undefined ? undefined : eye.value.distanceTo(SKIN.set(...skin.skinMm)),
    });
    this.expose(performance.now());
  }

  private expose(nowMs: number): void {
    if (this.small === null || nowMs - this.exposedMs < EXPOSED_EVERY_MS) return;
    const seconds = (nowMs - this.exposedMs) / 1000;
    this.exposedMs = nowMs;
    this.small.drawImage(this.canvas, 0, 0, EXPOSED_PX, EXPOSED_PX);
    const { data } = this.small.getImageData(0, 0, EXPOSED_PX, EXPOSED_PX);
    const { exposure } = this.lens;
    exposure.value = nextExposure(exposure.value, meanGrey(data), seconds);
  }

  /** What the last picture took. */
  get budget(): { readonly calls: number; readonly triangles: number } {
    const { calls, triangles } = this.renderer.info.render;
    return { calls, triangles };
  }

  dispose(): void {
    this.backdrop.dispose();
    this.loose.dispose();
    this.beads.dispose();
    this.pieces.dispose();
    this.fluid.dispose();
    this.film.dispose();
    this.focus.dispose();
    this.screw.dispose();
    for (const geometry of Object.values(this.rods)) geometry.dispose();
    for (const geometry of this.skinTools.values()) geometry.dispose();
    this.depth.material.dispose();
    for (const mesh of [...this.walls.values(), this.rod]) {
      mesh.geometry.dispose();
      (mesh.material as THREE.Material).dispose();
    }
    this.renderer.dispose();
  }
}

/** Its shaft along +z, and what of it has a side, that side towards +x. */
function turnOf({ shaft, mouth }: Rod): THREE.Quaternion {
  const z = new THREE.Vector3(...shaft).normalize();
  if (mouth === undefined) {
    return new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), z);
  }
  const y = new THREE.Vector3().crossVectors(z, new THREE.Vector3(...mouth)).normalize();
  const x = new THREE.Vector3().crossVectors(y, z);
  return new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, y, z));
}

/** In the middle of its window [mm]. */
function mouthAt({ tipMm, shaft, mouth }: Rod): { readonly atMm: Vec3 } {
  const BEHIND_MM = 1.3;
  const OUT_MM = 0.7;
  const side = mouth ?? [0, 0, 0];
  return {
    atMm: [
      tipMm[0] + BEHIND_MM * shaft[0] + OUT_MM * side[0],
      tipMm[1] + BEHIND_MM * shaft[1] + OUT_MM * side[1],
      tipMm[2] + BEHIND_MM * shaft[2] + OUT_MM * side[2],
    ],
  };
}

function smallContext(): CanvasRenderingContext2D | null {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = EXPOSED_PX;
  return canvas.getContext("2d", { willReadFrequently: true });
}

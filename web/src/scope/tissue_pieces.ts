// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a shaver takes away, as far as the host has it left: tufts of inflamed synovium, flaps of a torn disc.
// One draw call, whatever their number. Generated, not seen in the CT.
import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import type { BodyPose, Vec3 } from "../protocol";
import { insideOut, linedAs } from "./inside_out";
import type { Plan } from "./scope_plan";

export type TissuePiece = Plan["pieces"][number];

const DISC = 1; // of the lining's four weights
/** A flap of the disc, which itself has no height [mm]. */
const FLAP_MM = 1.3;
const SWAY_RAD = 0.1;
/** So near to a running mouth they lean into it [mm]. */
const DRAWN_MM = 2.5;
const DRAWN_RAD = 0.9;
/** The scope pushes aside what stands so near before its lens: all of it, and none [mm]. */
const ASIDE_MM = [0.8, 2.6] as const;
const NOT_SHOWN = 0.05;

export interface Suction {
  readonly atMm: Vec3;
}

export class TissuePieces {
  readonly group = new THREE.Group();
  private mesh: THREE.InstancedMesh | undefined;
  private pieces: readonly TissuePiece[] = [];
  /** By piece: its body, in the order of the poses. */
  private bodies: readonly number[] = [];
  /** By piece: where it stands and which way, as the bones are now. */
  private readonly stands: { at: THREE.Vector3; inwards: THREE.Vector3 }[] = [];

  constructor(private readonly material: THREE.Material) {}

  /** @param names  of the bodies in the order of the poses */
  set(pieces: readonly TissuePiece[], names: readonly string[]): void {
    this.dispose();
    this.pieces = pieces;
    this.bodies = pieces.map((piece) => names.indexOf(piece.body));
    this.stands.length = 0;
    for (const piece of pieces) {
      this.stands.push({
        at: new THREE.Vector3(...piece.at_mm),
        inwards: new THREE.Vector3(...piece.inwards),
      });
    }
    const shown = pieces.filter(stands);
    if (shown.length === 0) return;
    const geometry = shown[0]?.kind === "disc" ? flapGeometry() : tuftGeometry();
    this.mesh = new THREE.InstancedMesh(geometry, this.material, shown.length);
    this.mesh.frustumCulled = false; // the lens is no frustum
    this.group.add(this.mesh);
  }

  /** The bones have moved. */
  lay(poses: readonly BodyPose[]): void {
    const turn = new THREE.Quaternion();
    this.pieces.forEach((piece, i) => {
      const pose = poses[this.bodies[i] ?? -1];
      const stand = this.stands[i];
      if (stand === undefined) return;
      stand.at.set(...piece.at_mm);
      stand.inwards.set(...piece.inwards);
      if (pose === undefined) return;
      const [w, x, y, z] = pose.quaternion;
      turn.set(x, y, z, w);
      stand.at.applyQuaternion(turn).add(new THREE.Vector3(...pose.translation_mm));
      stand.inwards.applyQuaternion(turn);
    });
  }

  /**
   * @param left  of each in percent, as the host says
   * @param eyeMm  where the lens is
   * @param seconds  by which they sway; the same where nothing is to move
   */
  show(
    joint: string,
    left: readonly number[],
    suction: Suction | undefined,
    eyeMm: Vec3,
    seconds: number,
  ): void {
    const { mesh } = this;
    if (mesh === undefined) return;
    const matrix = new THREE.Matrix4();
    const drawn = new THREE.Vector3();
    const eye = new THREE.Vector3(...eyeMm);
    let place = 0;
    this.pieces.forEach((piece, i) => {
      const stand = this.stands[i];
      const share = (left[i] ?? 100) / 100;
      if (!stands(piece) || stand === undefined || piece.joint !== joint || share <= 0) return;
      const up = stand.inwards.clone();
      const lean = across(up, i, seconds);
      if (suction !== undefined) {
        drawn.set(...suction.atMm).sub(stand.at);
        const near = 1 - drawn.length() / DRAWN_MM;
        if (near > 0) lean.lerp(drawn.normalize().multiplyScalar(DRAWN_RAD), near);
      }
      up.add(lean).normalize();
      const [all, none] = ASIDE_MM;
      const upright = THREE.MathUtils.smoothstep(eye.distanceTo(stand.at), all, none);
      if (upright < NOT_SHOWN) return;
      const isFlap = piece.kind === "disc";
      const high = (isFlap ? FLAP_MM : piece.height_mm) * (0.35 + 0.65 * share) * upright;
      const wide = piece.radius_mm * (isFlap ? 1.3 : 1.15) * (0.5 + 0.5 * share) * upright;
      mesh.setMatrixAt(place, standing(matrix, stand.at, up, i, wide, high));
      ++place;
    });
    mesh.count = place;
    mesh.visible = place > 0;
    mesh.instanceMatrix.needsUpdate = true;
  }

  dispose(): void {
    this.mesh?.geometry.dispose();
    this.mesh?.dispose();
    this.mesh = undefined;
    this.group.clear();
  }
}

/** What is sound of the disc is the joint's wall. */
export function stands(piece: TissuePiece): boolean {
  return piece.kind === "synovium" || piece.is_loose;
}

/** Each in its own time. */
function across(up: THREE.Vector3, i: number, seconds: number): THREE.Vector3 {
  const side = new THREE.Vector3(0.6, 0.7, -0.4).cross(up).normalize();
  const other = new THREE.Vector3().crossVectors(up, side);
  const t = 1.3 * seconds + 2.4 * i;
  return side
    .multiplyScalar(SWAY_RAD * Math.sin(t) + 0.25 * Math.sin(5.1 * i))
    .addScaledVector(other, SWAY_RAD * Math.sin(0.83 * t + 1.7) + 0.25 * Math.cos(3.7 * i));
}

function standing(
  matrix: THREE.Matrix4,
  at: THREE.Vector3,
  up: THREE.Vector3,
  i: number,
  wide: number,
  high: number,
): THREE.Matrix4 {
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), up);
  turn.multiply(new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), 2.4 * i));
  return matrix.compose(at, turn, new THREE.Vector3(wide, wide, high));
}

/** Along a finger: how high, and how thick; club-shaped, as villi are. Its root goes on into the wall. */
const FINGER: readonly (readonly [number, number])[] = [
  [-0.4, 1.25],
  [0, 1.1],
  [0.3, 0.95],
  [0.55, 0.85],
  [0.75, 0.98],
  [0.9, 0.8],
  [0.97, 0.45],
  [1, 0],
];
const FLAP: readonly (readonly [number, number])[] = [
  [-0.6, 1],
  [0.25, 1],
  [0.6, 0.85],
  [0.85, 0.5],
  [1, 0],
];
const SIDES = 6;

interface Finger {
  /** Where it stands about the foot, and which way it leans. */
  readonly aside: number;
  readonly way: number;
  readonly thick: number;
  readonly tall: number;
  readonly bend: number;
}

/** From the ground up, bent outwards. */
function finger(
  { aside, way, thick, tall, bend }: Finger,
  profile: readonly (readonly [number, number])[] = FINGER,
): THREE.BufferGeometry {
  const shape = new THREE.LatheGeometry(
    profile.map(([z, r]) => new THREE.Vector2(r * thick, z * tall)),
    SIDES,
  );
  shape.rotateX(Math.PI / 2);
  shape.deleteAttribute("uv");
  const at = shape.getAttribute("position");
  for (let v = 0; v < at.count; ++v) {
    const z = at.getZ(v);
    const out = aside + bend * Math.max(0, z) ** 2;
    const wave =
      (0.06 * Math.sin(5 * z + 3 * way) + 0.04 * Math.sin(11 * z + way)) * Math.max(0, z);
    const x = at.getX(v) + out * Math.cos(way) - wave * Math.sin(way);
    const y = at.getY(v) + out * Math.sin(way) + wave * Math.cos(way);
    at.setXYZ(v, x, y, z);
  }
  shape.computeVertexNormals();
  return shape;
}

/** Villi: fingers from one foot. Unit height, unit radius. */
export function tuftGeometry(): THREE.BufferGeometry {
  const merged = mergeGeometries(
    [
      { aside: 0.1, way: 0.3, thick: 0.15, tall: 1, bend: 0.2 },
      { aside: 0.4, way: 0.1, thick: 0.13, tall: 0.84, bend: 0.45 },
      { aside: 0.55, way: 1.0, thick: 0.14, tall: 0.66, bend: 0.3 },
      { aside: 0.35, way: 1.9, thick: 0.12, tall: 0.93, bend: 0.5 },
      { aside: 0.6, way: 2.6, thick: 0.15, tall: 0.6, bend: 0.25 },
      { aside: 0.42, way: 3.5, thick: 0.13, tall: 0.88, bend: 0.4 },
      { aside: 0.58, way: 4.4, thick: 0.14, tall: 0.7, bend: 0.35 },
      { aside: 0.38, way: 5.3, thick: 0.12, tall: 0.8, bend: 0.55 },
    ].map((one) => finger(one)),
  );
  return linedAs(insideOut(merged), undefined);
}

/** A flat tag, thinner towards its ragged end. */
export function flapGeometry(): THREE.BufferGeometry {
  const shape = finger({ aside: 0, way: 0, thick: 1, tall: 1, bend: 0.6 }, FLAP);
  const at = shape.getAttribute("position");
  for (let v = 0; v < at.count; ++v) {
    const z = at.getZ(v);
    at.setY(v, at.getY(v) * 0.22 + 0.12 * Math.sin(7 * at.getX(v) + 4 * z));
  }
  shape.computeVertexNormals();
  return linedAs(insideOut(shape), DISC);
}

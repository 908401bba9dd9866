// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The skin as a see-through shell that follows forearm and hand (skin_blend_model.ts); its shader moves
// each point, so that a bent wrist costs no more than a straight one. Closed it goes on beyond the scan,
// with fingers and an arm that are generated.
import * as THREE from "three";
import { MeshBVH } from "three-mesh-bvh";
import type { Matrix16 } from "../frames";
import type { Vec3 } from "../protocol";
import { BLEND_DECLARATIONS } from "./blend_shader";
import { makeHittable } from "./bone_rays";
import { closedSkinMaterial, depthOnlyMaterial, skinMaterial } from "./materials";
import { creaseUniforms } from "./skin_creases";
import {
  blendedPoint,
  dualQuaternion,
  evened,
  handWeights,
  sideOf,
  type DualQuaternion,
  type RigidMotion,
  type SkinSide,
} from "./skin_blend_model";
import { apartFrom, nearestOf, pointsAt, rimCorners } from "./skin_rim_model";

/** The bones whose motion is that of their side of the skin, the first that is there. */
const CARRIERS = { forearm: ["radius", "ulna"], hand: ["capitate", "metacarpal3"] } as const;

/** A rim nearer to another's goes on there [mm]. */
const GOES_ON_MM = 5;
/** From a rim on, in so much what goes on takes a way and a light of its own [mm]. */
const OWN_WAY_MM = 60;
const OWN_LIGHT_MM = 10;
/** Width of the cloth at an open rim [mm]. */
const CUFF_MM = 8;
const DRAPE_MM = 60;

/** Where the limb goes on beyond the scan, by what carries it. */
export type Limbs = ReadonlyMap<SkinSide, THREE.BufferGeometry>;

/** Of a surface's open rim: its points [mm], and how they go with the hand. */
interface Rim {
  readonly points: Float32Array;
  readonly normals: Float32Array;
  readonly weights: readonly number[];
}

function positionsOf(geometry: THREE.BufferGeometry): ArrayLike<number> {
  return geometry.getAttribute("position").array;
}

function rimPoints(geometry: THREE.BufferGeometry): Float32Array {
  return pointsAt(positionsOf(geometry), rimCorners(geometry.getIndex()?.array ?? []));
}

function smoothStep(t: number): number {
  const within = Math.min(1, Math.max(0, t));
  return within * within * (3 - 2 * within);
}

const VERTEX = /* glsl */ `
attribute float handWeight;
attribute float fromRim;
${BLEND_DECLARATIONS}
varying vec3 vNormalView;
varying vec3 vToEye;
varying vec3 vBoneMm;
varying vec3 vOut;
varying float vFromRim;
void main() {
  blendBegin(handWeight);
  vBoneMm = position;
  vOut = normal;
  vFromRim = fromRim;
  vec4 inView = modelViewMatrix * vec4(blendMoved(position), 1.0);
  vNormalView = normalMatrix * blendTurned(normal);
  vToEye = -inView.xyz;
  gl_Position = projectionMatrix * inView;
}
`;

/** A place of the skin [mm]. */
export interface SkinPlace {
  readonly at: Vec3;
  /** Unit, out of the body. */
  readonly out: Vec3;
}

type ClosedSkin = THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;

export class Skin {
  readonly group = new THREE.Group();
  private readonly limbs: ClosedSkin[] = [];
  private readonly shell: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;
  private readonly depth: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;
  private readonly closed: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;
  private readonly motions: Record<SkinSide, DualQuaternion> = {
    forearm: { real: [0, 0, 0, 1], dual: [0, 0, 0, 0] },
    hand: { real: [0, 0, 0, 1], dual: [0, 0, 0, 0] },
  };
  private posed: THREE.Mesh | undefined;
  private hasMoved = false;
  private readonly motion = {
    forearmReal: { value: new THREE.Vector4(0, 0, 0, 1) },
    forearmDual: { value: new THREE.Vector4(0, 0, 0, 0) },
    handReal: { value: new THREE.Vector4(0, 0, 0, 1) },
    handDual: { value: new THREE.Vector4(0, 0, 0, 0) },
  };
  private readonly carriers: ReadonlySet<string>;

  /** @param bones  where they are in the case, in the same frame as the skin [mm] */
  constructor(surface: THREE.BufferGeometry, bones: readonly THREE.Mesh[], limbs: Limbs) {
    const points = bones.map((bone) => ({
      name: bone.name,
      positions: bone.geometry.getAttribute("position").array,
    }));
    const nearest = handWeights(surface.getAttribute("position").array, points);
    const weights = evened(nearest, surface.getIndex()?.array ?? []);
    surface.setAttribute("handWeight", new THREE.BufferAttribute(weights, 1));
    const corners = rimCorners(surface.getIndex()?.array ?? []);
    const rim: Rim = {
      points: pointsAt(positionsOf(surface), corners),
      normals: pointsAt(surface.getAttribute("normal").array, corners),
      weights: corners.map((corner) => weights[corner] ?? 0),
    };
    const goesOn = [...limbs.values()].map(rimPoints);
    const open = goesOn.reduce((left, other) => apartFrom(left, other, GOES_ON_MM), rim.points);
    const fromRim = nearestOf(positionsOf(surface), open).distances;
    surface.setAttribute("fromRim", new THREE.BufferAttribute(fromRim, 1));
    const carriers = Object.values(CARRIERS).map((names) =>
      names.find((name) => bones.some((bone) => bone.name === name)),
    );
    this.carriers = new Set(carriers.filter((name) => name !== undefined));
    this.depth = new THREE.Mesh(surface, depthOnlyMaterial(VERTEX));
    this.depth.renderOrder = 5;
    this.shell = new THREE.Mesh(surface, skinMaterial(VERTEX));
    this.shell.renderOrder = 6;
    this.closed = new THREE.Mesh(surface, closedSkinMaterial(VERTEX, CUFF_MM));
    for (const [side, limb] of limbs) this.limbs.push(this.makeLimb(side, limb, rim));
    this.closed.visible = false;
    for (const mesh of [this.depth, this.shell, this.closed, ...this.limbs]) {
      Object.assign(mesh.material.uniforms, this.motion);
      // Its bounds are those of the unbent wrist.
      mesh.frustumCulled = false;
      this.group.add(mesh);
    }
  }

  /** It leaves the skin's rim as the skin comes to it: moved alike, in the same light. */
  private makeLimb(side: SkinSide, limb: THREE.BufferGeometry, rim: Rim): ClosedSkin {
    const positions = positionsOf(limb);
    const { distances, indices } = nearestOf(positions, rim.points);
    const own = side === "hand" ? 1 : 0;
    const weights = distances.map((mm, v) => {
      const there = rim.weights[indices[v] ?? 0] ?? own;
      return there + (own - there) * smoothStep(mm / OWN_WAY_MM);
    });
    const normals = limb.getAttribute("normal");
    for (let v = 0; v < distances.length; ++v) {
      const share = smoothStep((distances[v] ?? 0) / OWN_LIGHT_MM);
      const there = 3 * (indices[v] ?? 0);
      const mixed = new THREE.Vector3()
        .fromArray(rim.normals, there)
        .lerp(new THREE.Vector3().fromBufferAttribute(normals, v), share)
        .normalize();
      normals.setXYZ(v, mixed.x, mixed.y, mixed.z);
    }
    limb.setAttribute("handWeight", new THREE.BufferAttribute(weights, 1));
    const open = apartFrom(rimPoints(limb), rim.points, GOES_ON_MM);
    limb.setAttribute(
      "fromRim",
      new THREE.BufferAttribute(nearestOf(positions, open).distances, 1),
    );
    const mesh = new THREE.Mesh(limb, closedSkinMaterial(VERTEX, DRAPE_MM));
    mesh.visible = false;
    return mesh;
  }

  /** @param rendererFromPatient  of the forearm as scanned */
  layCreases(rendererFromPatient: Matrix16): void {
    const uniforms = creaseUniforms(rendererFromPatient);
    for (const mesh of [this.closed, ...this.limbs])
      Object.assign(mesh.material.uniforms, uniforms);
  }

  /** @param opacity  0 none, 1 as on the patient */
  setOpacity(opacity: number): void {
    this.group.visible = opacity > 0;
    const uniform = this.shell.material.uniforms["opacity"];
    if (uniform !== undefined) uniform.value = opacity;
  }

  /** Whether nothing is seen through it, whatever the opacity. */
  setClosed(on: boolean): void {
    for (const mesh of [this.closed, ...this.limbs]) mesh.visible = on;
    this.depth.visible = this.shell.visible = !on;
    if (on) this.group.visible = true;
  }

  /** The nearest place of it as it lies now, in the frame that it is in [mm]. */
  nearest(at: Vec3): SkinPlace {
    const { geometry } = this.hittable();
    const tree = geometry.boundsTree;
    const hit = tree instanceof MeshBVH ? tree.closestPointToPoint(new THREE.Vector3(...at)) : null;
    const index = geometry.getIndex();
    if (hit === null || index === null) return { at, out: [0, 0, 1] };
    const [a, b, c] = [0, 1, 2].map((corner) =>
      new THREE.Vector3().fromBufferAttribute(
        geometry.getAttribute("position"),
        index.getX(3 * hit.faceIndex + corner),
      ),
    ) as [THREE.Vector3, THREE.Vector3, THREE.Vector3];
    const out = new THREE.Triangle(a, b, c).getNormal(new THREE.Vector3());
    return { at: hit.point.toArray(), out: out.toArray() };
  }

  /** The skin as it lies now, for rays; made anew when it was moved since. */
  hittable(): THREE.Mesh {
    this.posed ??= this.makeHittable();
    if (this.hasMoved) this.moveHittable(this.posed);
    return this.posed;
  }

  private makeHittable(): THREE.Mesh {
    const mesh = new THREE.Mesh(this.closed.geometry.clone());
    mesh.visible = false;
    this.group.add(mesh);
    mesh.updateWorldMatrix(true, false);
    makeHittable(mesh);
    this.hasMoved = true;
    return mesh;
  }

  private moveHittable(mesh: THREE.Mesh): void {
    this.hasMoved = false;
    const from = this.closed.geometry.getAttribute("position").array;
    const weights = this.closed.geometry.getAttribute("handWeight").array;
    const to = mesh.geometry.getAttribute("position").array;
    const { forearm, hand } = this.motions;
    for (let v = 0; v < weights.length; ++v) {
      const point: Vec3 = [from[3 * v] ?? 0, from[3 * v + 1] ?? 0, from[3 * v + 2] ?? 0];
      to.set(blendedPoint(point, forearm, hand, weights[v] ?? 0), 3 * v);
    }
    mesh.geometry.boundsTree?.refit();
    mesh.geometry.computeBoundingSphere();
    mesh.geometry.computeBoundingBox();
  }

  /** A bone has moved: the skin goes with those that carry it. */
  follow(bone: string, motion: RigidMotion): void {
    const side = this.carriers.has(bone) ? sideOf(bone) : undefined;
    if (side === undefined) return;
    const { dual, real } = dualQuaternion(motion);
    this.motions[side] = { real, dual };
    this.hasMoved = true;
    this.motion[`${side}Real`].value.set(...real);
    this.motion[`${side}Dual`].value.set(...dual);
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The skin as a see-through shell that follows forearm and hand (skin_blend_model.ts); its shader moves
// each point, so that a bent wrist costs no more than a straight one.
import * as THREE from "three";
import type { Vec3 } from "../protocol";
import { BLEND_DECLARATIONS } from "./blend_shader";
import { makeHittable } from "./bone_rays";
import { closedSkinMaterial, depthOnlyMaterial, skinMaterial } from "./materials";
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
import { distanceFromRim } from "./skin_rim_model";

/** The bones whose motion is that of their side of the skin, the first that is there. */
const CARRIERS = { forearm: ["radius", "ulna"], hand: ["capitate", "metacarpal3"] } as const;

const VERTEX = /* glsl */ `
attribute float handWeight;
attribute float fromRim;
${BLEND_DECLARATIONS}
varying vec3 vNormalView;
varying vec3 vToEye;
varying vec3 vBoneMm;
varying float vFromRim;
void main() {
  blendBegin(handWeight);
  vBoneMm = position;
  vFromRim = fromRim;
  vec4 inView = modelViewMatrix * vec4(blendMoved(position), 1.0);
  vNormalView = normalMatrix * blendTurned(normal);
  vToEye = -inView.xyz;
  gl_Position = projectionMatrix * inView;
}
`;

export class Skin {
  readonly group = new THREE.Group();
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
  constructor(surface: THREE.BufferGeometry, bones: readonly THREE.Mesh[]) {
    const points = bones.map((bone) => ({
      name: bone.name,
      positions: bone.geometry.getAttribute("position").array,
    }));
    const nearest = handWeights(surface.getAttribute("position").array, points);
    const weights = evened(nearest, surface.getIndex()?.array ?? []);
    surface.setAttribute("handWeight", new THREE.BufferAttribute(weights, 1));
    const fromRim = distanceFromRim(
      surface.getAttribute("position").array,
      surface.getIndex()?.array ?? [],
    );
    surface.setAttribute("fromRim", new THREE.BufferAttribute(fromRim, 1));
    const carriers = Object.values(CARRIERS).map((names) =>
      names.find((name) => bones.some((bone) => bone.name === name)),
    );
    this.carriers = new Set(carriers.filter((name) => name !== undefined));
    this.depth = new THREE.Mesh(surface, depthOnlyMaterial(VERTEX));
    this.depth.renderOrder = 5;
    this.shell = new THREE.Mesh(surface, skinMaterial(VERTEX));
    this.shell.renderOrder = 6;
    this.closed = new THREE.Mesh(surface, closedSkinMaterial(VERTEX));
    this.closed.visible = false;
    for (const mesh of [this.depth, this.shell, this.closed]) {
      Object.assign(mesh.material.uniforms, this.motion);
      // Its bounds are those of the unbent wrist.
      mesh.frustumCulled = false;
      this.group.add(mesh);
    }
  }

  /** @param opacity  0 none, 1 as on the patient */
  setOpacity(opacity: number): void {
    this.group.visible = opacity > 0;
    const uniform = this.shell.material.uniforms["opacity"];
    if (uniform !== undefined) uniform.value = opacity;
  }

  /** Whether nothing is seen through it, whatever the opacity. */
  setClosed(on: boolean): void {
    this.closed.visible = on;
    this.depth.visible = this.shell.visible = !on;
    if (on) this.group.visible = true;
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

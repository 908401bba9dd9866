// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tendons, arteries and nerves as tubes that bend with the wrist as the host bends them. They were
// generated from the generic wrist, not seen in the CT: who shows them says so.
import * as THREE from "three";
import type { Look } from "../appearance";
import type { Vec3 } from "../protocol";
import { applyMaterial } from "./apply_material";
import { structureMaterial, type BlendUniforms } from "./materials";
import {
  blendedPoint,
  dualQuaternion,
  type DualQuaternion,
  type RigidMotion,
} from "./skin_blend_model";
import {
  carriedBy,
  isStructure,
  type Carrier,
  type StructureFacts,
  type StructureKind,
} from "./structure_model";

/** A mesh of the host's scene that is a structure, with what the host says of it. */
export interface StructureSurface {
  readonly facts: StructureFacts;
  readonly geometry: THREE.BufferGeometry;
}

/** What the host's scene says of a node, if that is a structure. */
export function structureFacts(extras: unknown): StructureFacts | undefined {
  return isStructure(extras) ? extras : undefined;
}

const RESTING: DualQuaternion = { real: [0, 0, 0, 1], dual: [0, 0, 0, 0] };

interface Named {
  readonly forearm: Carrier;
  readonly middle: Vec3;
  readonly share: number;
  readonly marker: THREE.Object3D;
}

export class Structures {
  readonly group = new THREE.Group();
  /** Where each is now, for its name; empty of all else. */
  readonly markers: readonly THREE.Object3D[];
  private readonly named: readonly Named[];
  private readonly painted: {
    readonly kind: StructureKind;
    readonly material: THREE.MeshPhysicalMaterial;
  }[] = [];
  private readonly motions: Record<Carrier, DualQuaternion> = {
    radius: RESTING,
    ulna: RESTING,
    hand: RESTING,
  };
  private readonly uniforms: Record<
    Carrier,
    { readonly real: { value: THREE.Vector4 }; readonly dual: { value: THREE.Vector4 } }
  >;

  constructor(surfaces: readonly StructureSurface[], bones: ReadonlySet<string>) {
    const uniform = (): { real: { value: THREE.Vector4 }; dual: { value: THREE.Vector4 } } => ({
      real: { value: new THREE.Vector4(0, 0, 0, 1) },
      dual: { value: new THREE.Vector4(0, 0, 0, 0) },
    });
    this.uniforms = { radius: uniform(), ulna: uniform(), hand: uniform() };
    this.named = surfaces.map((surface) => this.add(surface, bones));
    this.markers = this.named.map(({ marker }) => marker);
    this.group.visible = false;
  }

  /** Gives each kind its material. */
  apply(materials: Look["materials"]): void {
    for (const { kind, material } of this.painted) applyMaterial(material, materials[kind]);
  }

  get isEmpty(): boolean {
    return this.named.length === 0;
  }

  private add({ facts, geometry }: StructureSurface, bones: ReadonlySet<string>): Named {
    // Without its bone the forearm's end goes with the other one.
    const other = facts.forearm === "radius" ? "ulna" : "radius";
    const forearm = bones.has(facts.forearm) ? facts.forearm : other;
    const motion: BlendUniforms = {
      forearmReal: this.uniforms[forearm].real,
      forearmDual: this.uniforms[forearm].dual,
      handReal: this.uniforms.hand.real,
      handDual: this.uniforms.hand.dual,
    };
    const material = structureMaterial(facts.structure, motion);
    this.painted.push({ kind: facts.structure, material });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.name = facts.title;
    // Its bounds are those of the unbent wrist.
    mesh.frustumCulled = false;
    const marker = new THREE.Object3D();
    marker.name = facts.title;
    const positions = geometry.getAttribute("position");
    const shares = geometry.getAttribute("_hand_share");
    const at = Math.floor(0.62 * positions.count);
    const middle: Vec3 = [positions.getX(at), positions.getY(at), positions.getZ(at)];
    marker.position.set(...middle);
    this.group.add(mesh, marker);
    return { forearm, middle, share: shares.getX(at), marker };
  }

  /** A bone has moved: what it carries goes with it. */
  follow(bone: string, motion: RigidMotion): void {
    const carrier = carriedBy(bone);
    if (carrier === undefined) return;
    const moved = dualQuaternion(motion);
    this.motions[carrier] = moved;
    this.uniforms[carrier].real.value.set(...moved.real);
    this.uniforms[carrier].dual.value.set(...moved.dual);
    for (const { forearm, middle, share, marker } of this.named) {
      if (carrier !== "hand" && carrier !== forearm) continue;
      marker.position.set(...blendedPoint(middle, this.motions[forearm], this.motions.hand, share));
      marker.updateWorldMatrix(true, false);
    }
  }
}

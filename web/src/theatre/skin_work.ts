// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is done to closed skin, as the host says it: a ring under the fingertip that is firm or soft, ink,
// cuts, a drop at the needle's hub; on request, in practice, where the next portal is. Frame Patient [mm].
import * as THREE from "three";
import type { FeltThroughSkin, SkinMessage, SnapshotMessage, Vec3 } from "../protocol";
import { ACCENT_COLOR, ATTENTION_COLOR } from "./materials";
import type { SkinPlace } from "./skin";

const INK_COLOR = "#2b2470";
const CUT_COLOR = "#7d0d12";
const SPREAD_COLOR = "#3a0508";
const DROP_COLOR = "#d9ecf5";
const RING_COLORS: Readonly<Record<FeltThroughSkin, string>> = {
  nothing: "#c8d2da",
  soft: "#9fd0a8",
  cord: ATTENTION_COLOR,
  bone: "#ffffff",
};
const MOST_INK = 96;
const MOST_CUTS = 8;
const INK_RADIUS_MM = 0.55;
/** Off the skin, so that it does not flicker. */
const RAISED_MM = 0.15;
const CUT_WIDTH_MM = 0.5;
const SPREAD_WIDTH_MM = 2.2;
const HUB_MM = 41;
const DROP_MM = 1.6;
const Z = new THREE.Vector3(0, 0, 1);
const normal = new THREE.Vector3();
const along = new THREE.Vector3();
const place = new THREE.Object3D();

function flat(color: string): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({
    color,
    side: THREE.DoubleSide,
    toneMapped: false,
    // Before the skin that it lies on, behind what stands before it.
    polygonOffset: true,
    polygonOffsetFactor: -8,
    polygonOffsetUnits: -200,
  });
}

export class SkinWork {
  readonly group = new THREE.Group();
  private readonly ring = new THREE.Mesh(new THREE.RingGeometry(0.8, 1, 48), flat("#ffffff"));
  private readonly ink = new THREE.InstancedMesh(
    new THREE.CircleGeometry(INK_RADIUS_MM, 16),
    flat(INK_COLOR),
    MOST_INK,
  );
  private readonly cuts: readonly THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>[];
  private readonly drop = new THREE.Mesh(
    new THREE.SphereGeometry(DROP_MM, 20, 14),
    new THREE.MeshStandardMaterial({ color: DROP_COLOR, roughness: 0.05, transparent: true }),
  );
  private readonly spot = new THREE.Mesh(new THREE.RingGeometry(1.6, 2, 48), flat(ACCENT_COLOR));
  private readonly landmark = new THREE.Mesh(
    new THREE.RingGeometry(1.6, 2, 48),
    flat(ATTENTION_COLOR),
  );
  private told: SkinMessage | undefined;
  private aidsAreShown = false;
  private inkLaid = "";

  /** @param onSkin  the nearest place of the skin as it is drawn */
  constructor(private readonly onSkin: (at: Vec3) => SkinPlace) {
    this.ink.count = 0;
    this.ink.frustumCulled = false;
    // Pointed at both ends, as a blade leaves it.
    const shape = new THREE.Shape();
    shape.moveTo(-0.5, 0);
    shape.quadraticCurveTo(0, 0.5, 0.5, 0);
    shape.quadraticCurveTo(0, -0.5, -0.5, 0);
    const geometry = new THREE.ShapeGeometry(shape, 12);
    this.cuts = Array.from({ length: MOST_CUTS }, () => new THREE.Mesh(geometry, flat(CUT_COLOR)));
    this.group.add(this.ring, this.ink, ...this.cuts, this.drop, this.spot, this.landmark);
    this.show(undefined, undefined);
  }

  showAids(on: boolean): void {
    this.aidsAreShown = on;
    this.show(this.told, undefined);
  }

  /** @param now  where the needle is whose hub drips; undefined: as it was */
  show(message: SkinMessage | undefined, now: SnapshotMessage | undefined): void {
    this.told = message;
    this.group.visible = message !== undefined;
    if (message === undefined) return;
    this.showRing(message);
    this.layInk(message.ink_mm);
    this.cuts.forEach((mesh, i) => {
      this.showCut(mesh, message.cuts[i]);
    });
    this.showMark(this.spot, message.spot_mm);
    this.showMark(this.landmark, message.landmark_mm);
    if (now !== undefined) this.showDrop(message, now);
  }

  private layInk(ink: SkinMessage["ink_mm"]): void {
    const laid = `${ink.length} ${String(ink[0])}`;
    if (laid === this.inkLaid) return;
    this.inkLaid = laid;
    ink.forEach((at, i) => {
      this.lay(place, at);
      place.updateMatrix();
      this.ink.setMatrixAt(i, place.matrix);
    });
    this.ink.count = ink.length;
    this.ink.instanceMatrix.needsUpdate = true;
  }

  private showRing({ hands }: SkinMessage): void {
    const hand = hands.find((one) => one.felt !== "nothing");
    this.ring.visible = hand !== undefined;
    if (hand === undefined) return;
    this.lay(this.ring, hand.on_skin_mm);
    // Soft is wide and thin, hard small and bold.
    this.ring.scale.setScalar(11 - 4 * hand.firm_share);
    this.ring.material.color.set(RING_COLORS[hand.felt]);
  }

  private showCut(
    mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>,
    cut: SkinMessage["cuts"][number] | undefined,
  ): void {
    mesh.visible = cut !== undefined;
    if (cut === undefined) return;
    along.set(...cut.to_mm).sub(place.position.set(...cut.from_mm));
    const long = Math.max(0.4, along.length());
    const middle: Vec3 = [
      (cut.from_mm[0] + cut.to_mm[0]) / 2,
      (cut.from_mm[1] + cut.to_mm[1]) / 2,
      (cut.from_mm[2] + cut.to_mm[2]) / 2,
    ];
    this.lay(mesh, middle);
    along.addScaledVector(normal, -along.dot(normal)).normalize();
    if (along.lengthSq() > 0.5) {
      const across = place.up.clone().crossVectors(normal, along);
      mesh.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(along, across, normal));
    }
    mesh.scale.set(long, cut.is_spread ? SPREAD_WIDTH_MM : 2 * CUT_WIDTH_MM, 1);
    mesh.material.color.set(cut.is_spread ? SPREAD_COLOR : CUT_COLOR);
  }

  private showMark(mesh: THREE.Mesh, at: Vec3 | null): void {
    mesh.visible = this.aidsAreShown && at !== null;
    if (at !== null) this.lay(mesh, at);
  }

  private showDrop({ hands }: SkinMessage, now: SnapshotMessage): void {
    const wet = hands.findIndex((one) => one.is_wet);
    const item = now.items.find((one) => one.hand === wet);
    this.drop.visible = wet >= 0 && item !== undefined;
    if (item === undefined) return;
    this.drop.position.set(...item.tip_mm).addScaledVector(along.set(...item.shaft), HUB_MM);
  }

  /** Flat on the skin as it is drawn; leaves which way is out in `normal`. */
  private lay(mesh: THREE.Object3D, at: Vec3): void {
    const on = this.onSkin(at);
    normal.set(...on.out);
    mesh.quaternion.setFromUnitVectors(Z, normal);
    mesh.position.set(...on.at).addScaledVector(normal, RAISED_MM);
  }

  dispose(): void {
    this.group.traverse((node) => {
      if (node instanceof THREE.Mesh) {
        const mesh = node as THREE.Mesh<THREE.BufferGeometry, THREE.Material>;
        mesh.geometry.dispose();
        mesh.material.dispose();
      }
    });
    this.ink.dispose();
  }
}

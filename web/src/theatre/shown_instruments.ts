// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Wire, screw and drivers where the snapshot has them, and the mark where the tip touches.
import * as THREE from "three";
import type { SnapshotMessage, Vec3 } from "../protocol";
import { ContactMarker } from "./contact_marker";
import {
  screwDriverParts,
  screwParts,
  wireDriverParts,
  wireParts,
  type ScrewShape,
} from "./instrument_set";
import {
  alignShaft,
  castShadows,
  clearInstrument,
  drawInstrument,
  fillInstrument,
} from "./instruments";

/** A driver that comes towards the viewer more steeply than this would hide what it points at. */
const HIDE_DRIVER_COSINE = 0.25;

export class ShownInstruments {
  readonly group = new THREE.Group();
  private readonly wire = drawInstrument(wireParts());
  private readonly driver = drawInstrument(wireDriverParts());
  private readonly handDriver = drawInstrument(screwDriverParts());
  private readonly screw = new THREE.Group();
  private readonly marker = new ContactMarker();
  private readonly screwTip: [number, number, number] = [0, 0, 0];
  private readonly shaft: [number, number, number] = [0, 0, 1];
  private screwKey = "";

  constructor() {
    castShadows(this.wire);
    for (const object of [this.wire, this.driver, this.handDriver, this.screw]) {
      object.visible = false;
      this.group.add(object);
    }
    this.group.add(this.marker.group);
  }

  /** Draws the screw with this shape from now on. @return whether it is another */
  setScrewShape(shape: ScrewShape): boolean {
    const key = `${shape.length_mm} ${shape.tip_diameter_mm} ${shape.tail_diameter_mm}`;
    if (key === this.screwKey) return false;
    this.screwKey = key;
    fillInstrument(this.screw, screwParts(shape));
    return true;
  }

  /** @param towardsViewer  cosine between a direction of Patient and that towards the viewer */
  pose(s: SnapshotMessage, towardsViewer: (direction: Vec3) => number): void {
    const driverHides = towardsViewer(s.shaft) > HIDE_DRIVER_COSINE;
    this.wire.visible = s.instrument !== "none";
    if (s.wire_engaged) {
      this.setShaft(s.wire_direction, -1);
      alignShaft(this.wire, s.wire_tip_mm, this.shaft);
    } else {
      alignShaft(this.wire, s.tip_mm, s.shaft);
    }
    this.driver.visible = s.instrument === "guide_wire" && !driverHides;
    this.driver.position.copy(this.wire.position);
    this.driver.quaternion.copy(this.wire.quaternion);
    this.screw.visible = s.screw_index >= 0;
    this.handDriver.visible = s.instrument === "screw_driver" && !driverHides;
    if (this.screw.visible) this.poseScrew(s);
    if (s.touching) this.marker.show(s.tip_mm, s.contact_normal, s.force_n);
    else this.marker.hide();
  }

  private poseScrew(s: SnapshotMessage): void {
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

  private setShaft(direction: Vec3, sign: number): void {
    for (let i = 0; i < 3; ++i) this.shaft[i] = sign * (direction[i] ?? 0);
  }

  dispose(): void {
    for (const group of [this.wire, this.driver, this.handDriver, this.screw])
      clearInstrument(group);
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The items that are out of the tray, where the snapshot has them, and a mark where a tip touches.
import * as THREE from "three";
import type { Instrument, Item, SnapshotMessage, Vec3 } from "../protocol";
import { ContactMarker } from "./contact_marker";
import { alignShaft, castShadows, clearInstrument, drawInstrument } from "./instruments";

/** What holds an instrument would hide what it points at when it comes at the viewer more steeply. */
const HIDE_HOLDER_COSINE = 0.25;

interface Shown {
  readonly instrument: string;
  readonly body: THREE.Group;
  /** Driver or handle: only in a hand. */
  readonly holder: THREE.Group;
}

export class ShownInstruments {
  readonly group = new THREE.Group();
  private instruments: ReadonlyMap<string, Instrument> = new Map();
  private readonly shown = new Map<number, Shown>();
  private readonly markers = [new ContactMarker(), new ContactMarker()];

  constructor() {
    for (const marker of this.markers) this.group.add(marker.group);
  }

  /** What items are drawn from, from now on. */
  setInstruments(instruments: readonly Instrument[]): void {
    this.instruments = new Map(instruments.map((one) => [one.id, one]));
    this.clear();
  }

  /** @param towardsViewer  cosine between a direction of Patient and that towards the viewer */
  pose(s: SnapshotMessage, towardsViewer: (direction: Vec3) => number): void {
    for (const number of this.shown.keys()) {
      if (!s.items.some((item) => item.item === number)) this.remove(number);
    }
    for (const item of s.items) this.poseItem(item, towardsViewer);
    for (let hand = 0; hand < this.markers.length; ++hand) {
      const state = s.hands[hand as 0 | 1];
      const held = s.items.find((item) => item.item === state.item);
      if (held !== undefined && state.touching)
        this.markers[hand]?.show(held.tip_mm, state.contact_normal, state.force_n);
      else this.markers[hand]?.hide();
    }
  }

  private poseItem(item: Item, towardsViewer: (direction: Vec3) => number): void {
    const { body, holder } = this.drawn(item);
    alignShaft(body, item.tip_mm, item.shaft);
    holder.visible = item.hand >= 0 && towardsViewer(item.shaft) <= HIDE_HOLDER_COSINE;
    holder.position.copy(body.position);
    holder.quaternion.copy(body.quaternion);
  }

  private drawn(item: Item): Shown {
    const known = this.shown.get(item.item);
    if (known?.instrument === item.instrument) return known;
    if (known !== undefined) this.remove(item.item);
    const parts = this.instruments.get(item.instrument)?.parts ?? [];
    const drawn: Shown = {
      instrument: item.instrument,
      body: drawInstrument(parts.filter((part) => !part.only_in_hand)),
      holder: drawInstrument(parts.filter((part) => part.only_in_hand)),
    };
    castShadows(drawn.body);
    this.group.add(drawn.body, drawn.holder);
    this.shown.set(item.item, drawn);
    return drawn;
  }

  private remove(number: number): void {
    const drawn = this.shown.get(number);
    if (drawn === undefined) return;
    for (const group of [drawn.body, drawn.holder]) {
      this.group.remove(group);
      clearInstrument(group);
    }
    this.shown.delete(number);
  }

  private clear(): void {
    for (const number of [...this.shown.keys()]) this.remove(number);
  }

  dispose(): void {
    this.clear();
  }
}

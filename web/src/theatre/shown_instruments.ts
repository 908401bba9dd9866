// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The items that are out of the tray, where the snapshot has them, and a mark where a tip touches.
import * as THREE from "three";
import type { Instrument, InstrumentPart, Item, SnapshotMessage, Vec3 } from "../protocol";
import { ContactMarker } from "./contact_marker";
import { partsBetween } from "./instrument_model";
import {
  alignShaft,
  castShadows,
  clearInstrument,
  drawInstrument,
  fillInstrument,
} from "./instruments";

/** What holds an instrument would hide what it points at when it comes at the viewer more steeply. */
const HIDE_HOLDER_COSINE = 0.25;

/** Of a wire that is held beyond the bone, from its end to the driver's jaws [mm]. */
const FAR_GRASP_MM = 8;

interface Shown {
  readonly instrument: string;
  readonly body: THREE.Group;
  /** What stands off behind a bend. */
  readonly outer: THREE.Group;
  /** Up to where `body` is drawn, and to where `outer` [mm behind the tip]. */
  pieces: readonly [bentAtMm: number, lengthMm: number];
  /** Driver or handle: only in a hand. */
  readonly holder: THREE.Group;
}

function along(from: Vec3, direction: Vec3, mm: number): Vec3 {
  return [from[0] + direction[0] * mm, from[1] + direction[1] * mm, from[2] + direction[2] * mm];
}

function reversed([x, y, z]: Vec3): Vec3 {
  return [-x, -y, -z];
}

/** The tool frame's origin of a bent wire's outer part: straight on from the bend. */
function bentFrom(item: Item): Vec3 {
  const bend = along(item.tip_mm, item.shaft, item.bent_at_mm);
  return along(bend, item.outer_shaft, -item.bent_at_mm);
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
    const shown = this.drawn(item);
    const { body, outer, holder } = shown;
    this.drawPieces(shown, item);
    alignShaft(body, item.tip_mm, item.shaft);
    alignShaft(outer, bentFrom(item), item.outer_shaft);
    const away = item.by_far_end ? reversed(item.shaft) : item.shaft;
    holder.visible = item.hand >= 0 && towardsViewer(away) <= HIDE_HOLDER_COSINE;
    if (item.by_far_end) {
      alignShaft(holder, this.farHold(item), away);
    } else {
      holder.position.copy(body.position);
      holder.quaternion.copy(body.quaternion);
    }
  }

  /** Anew only when the wire bends or breaks. */
  private drawPieces(shown: Shown, item: Item): void {
    const pieces = [Math.min(item.bent_at_mm, item.length_mm), item.length_mm] as const;
    if (pieces[0] === shown.pieces[0] && pieces[1] === shown.pieces[1]) return;
    shown.pieces = pieces;
    const parts = this.partsOf(item).filter((part) => !part.only_in_hand);
    const isWhole = pieces[0] >= pieces[1] && parts.every((part) => part.to_mm <= pieces[1]);
    fillInstrument(shown.body, isWhole ? parts : partsBetween(parts, 0, pieces[0]));
    fillInstrument(shown.outer, isWhole ? [] : partsBetween(parts, pieces[0], pieces[1]));
    castShadows(shown.body);
    castShadows(shown.outer);
  }

  private partsOf(item: Item): readonly InstrumentPart[] {
    return this.instruments.get(item.instrument)?.parts ?? [];
  }

  /** Where the tool frame of what holds it lies, so that its jaws are at the far end. */
  private farHold(item: Item): Vec3 {
    const jaws = Math.min(
      ...this.partsOf(item)
        .filter((part) => part.only_in_hand)
        .map((part) => part.from_mm),
    );
    return along(item.tip_mm, item.shaft, FAR_GRASP_MM + jaws);
  }

  private drawn(item: Item): Shown {
    const known = this.shown.get(item.item);
    if (known?.instrument === item.instrument) return known;
    if (known !== undefined) this.remove(item.item);
    const parts = this.partsOf(item);
    const drawn: Shown = {
      instrument: item.instrument,
      body: drawInstrument(parts.filter((part) => !part.only_in_hand)),
      outer: new THREE.Group(),
      pieces: [Infinity, Infinity],
      holder: drawInstrument(parts.filter((part) => part.only_in_hand)),
    };
    castShadows(drawn.body);
    this.group.add(drawn.body, drawn.outer, drawn.holder);
    this.shown.set(item.item, drawn);
    return drawn;
  }

  private remove(number: number): void {
    const drawn = this.shown.get(number);
    if (drawn === undefined) return;
    for (const group of [drawn.body, drawn.outer, drawn.holder]) {
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

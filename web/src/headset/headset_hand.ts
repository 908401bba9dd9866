// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two controllers as the surgeon's hands: one is the instrument, the other holds table, wrist, pedal and clock.
import * as THREE from "three";
import type { FrameMap } from "../frames";
import type { HeldAction } from "../operation";
import type { Vec3 } from "../protocol";
import {
  instrumentWish,
  tableWish,
  type ControllerState,
  type HeadsetOnce,
} from "./controller_model";
import { carried, enlargedBy, type Placement } from "./wrist_placement";
import { nearer, toolOf } from "./tool_in_hand";

/** After a pause nothing jumps [s]. */
const LONGEST_FRAME_S = 0.1;
/** How fast an instrument that bone let go of comes to the hand again [mm/s]. */
const REJOIN_MM_PER_S = 150;
const TURN_RAD_PER_S = (60 * Math.PI) / 180;
/** The enlargement of a second of the stick. */
const GROWTH_PER_S = 2;
const NOTHING: ReadonlyMap<string, HeldAction> = new Map();

export interface HeadsetRoom {
  /** Whether the hand may be moved now: one operates, and no dialog is open. */
  isFree(): boolean;
  /** Whether the instrument goes where it is held: bone does not hold it. */
  canBePlaced(): boolean;
  tipMm(): Vec3;
  place(tipMm: Vec3, shaft: Vec3): void;
  hold(holder: string, action: HeldAction): void;
  letGo(holder: string): void;
  /** @param share  of the push that is set; undefined once the trigger is let go */
  squeeze(share: number | undefined): void;
  pedal(down: boolean): void;
  act(action: HeadsetOnce): void;
}

/** One controller at one moment, in the room. */
export interface Controller {
  readonly ray: THREE.Matrix4;
  readonly state: ControllerState;
}

export class HeadsetHand {
  private readonly before: Record<"instrument" | "table", ControllerState | undefined> = {
    instrument: undefined,
    table: undefined,
  };
  /** By what they hold: the instrument's driver, the wrist. */
  private readonly held: Record<"driver" | "wrist", ReadonlySet<string>> = {
    driver: new Set(),
    wrist: new Set(),
  };
  private pedalIsDown = false;
  private carriedFrom: THREE.Vector3 | undefined;
  private isAway = true;

  constructor(
    private readonly room: HeadsetRoom,
    private readonly frames: FrameMap,
  ) {}

  /**
   * @param instrument, table  undefined while a controller is not seen
   * @param placement  changed where the table is moved
   */
  frame(
    instrument: Controller | undefined,
    table: Controller | undefined,
    placement: Placement,
    rendererFromRoom: THREE.Matrix4,
    frameS: number,
  ): void {
    const seconds = Math.min(LONGEST_FRAME_S, Math.max(0, frameS));
    this.moveTable(table, placement, seconds);
    if (!this.room.isFree()) {
      this.rest();
      this.askPause(table);
    } else {
      this.operate(instrument, rendererFromRoom, seconds);
      this.attend(table);
    }
    this.before.instrument = instrument?.state;
    this.before.table = table?.state;
  }

  /** Lets everything go. */
  rest(): void {
    this.letDriverGo();
    this.keep("wrist", NOTHING);
    this.press(false);
  }

  private operate(hand: Controller | undefined, rendererFromRoom: THREE.Matrix4, s: number): void {
    if (hand === undefined) return this.letDriverGo();
    const wish = instrumentWish(hand.state, this.before.instrument);
    if (this.room.canBePlaced()) this.place(hand, rendererFromRoom, s);
    else this.isAway = true;
    this.room.squeeze(wish.held.has("headset drive") ? wish.squeeze : undefined);
    this.keep("driver", wish.held);
    for (const action of wish.once) this.room.act(action);
  }

  /** What is held no longer is let go. */
  private keep(what: "driver" | "wrist", wish: ReadonlyMap<string, HeldAction>): void {
    const before = this.held[what];
    for (const holder of before) if (!wish.has(holder)) this.room.letGo(holder);
    for (const [holder, action] of wish) if (!before.has(holder)) this.room.hold(holder, action);
    this.held[what] = new Set(wish.keys());
  }

  private place(hand: Controller, rendererFromRoom: THREE.Matrix4, seconds: number): void {
    const { tipMm, shaft } = toolOf(hand.ray, rendererFromRoom, this.frames);
    const to = this.isAway ? nearer(this.room.tipMm(), tipMm, REJOIN_MM_PER_S * seconds) : tipMm;
    this.isAway = to !== tipMm;
    this.room.place(to, shaft);
  }

  private letDriverGo(): void {
    if (this.held.driver.size > 0) this.room.squeeze(undefined);
    this.keep("driver", NOTHING);
    this.isAway = true;
  }

  private attend(table: Controller | undefined): void {
    const wish = table === undefined ? undefined : tableWish(table.state, this.before.table);
    this.press(wish?.pedal === true);
    this.keep("wrist", wish?.wrist ?? NOTHING);
    if (wish === undefined) return;
    for (const action of wish.once) this.room.act(action);
  }

  /** What stopped the clock starts it again. */
  private askPause(table: Controller | undefined): void {
    if (table === undefined) return;
    for (const action of tableWish(table.state, this.before.table).once)
      if (action.kind === "pause") this.room.act(action);
  }

  private moveTable(table: Controller | undefined, placement: Placement, seconds: number): void {
    const wish = table === undefined ? undefined : tableWish(table.state, this.before.table);
    if (table === undefined || wish === undefined) {
      this.carriedFrom = undefined;
      return;
    }
    const at = new THREE.Vector3().setFromMatrixPosition(table.ray);
    if (wish.carries && this.carriedFrom !== undefined) carried(placement, this.carriedFrom, at);
    this.carriedFrom = wish.carries ? at : undefined;
    placement.yawRad -= wish.turn * TURN_RAD_PER_S * seconds;
    if (wish.grow !== 0) enlargedBy(placement, GROWTH_PER_S ** (wish.grow * seconds));
  }

  private press(down: boolean): void {
    if (down === this.pedalIsDown) return;
    this.pedalIsDown = down;
    this.room.pedal(down);
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is asked for by keys, pointer or gamepad becomes one of the two hands: where it holds its
// instrument, how it pushes, the driver; the other hand stays where it is. It asks; which way the hand
// goes and where the instrument really is, the host says.
import {
  BY_KEYS,
  heldAction,
  heldItem,
  MAX_THRUST_N,
  otherHand,
  whyItKeepsStill,
  type Direction,
  type HandIndex,
  type HeldAction,
  type KeyPress,
  type LedWith,
  type WristAxis,
} from "../operation";
import type { HandMessage, Item, SnapshotMessage, Vec3 } from "../protocol";
import type { Theatre } from "../theatre";
import {
  add,
  approachedBy,
  begunBeforeSkin,
  cross,
  DEEPEST_MM,
  emptyHanded,
  givenWay,
  length,
  heldBackTo,
  movedBy,
  normalized,
  NOWHERE,
  scaled,
  subtract,
  takenOver,
  tipTarget,
  turnedBy,
  type ToolPose,
} from "../tool_placement";
import { HeldDown, type SteppedAction } from "./held_down";

const TURN_RAD_PER_PX = (0.25 * Math.PI) / 180;
/** A fine step never jumps to another bone that happens to lie on the line of sight. */
const FOLLOW_SURFACE_MM = 3;
/** A still hand is sent again after this long: the host pauses when it hears nothing [ms]. */
const REPEAT_MS = 250;
/** An operation's first instants swing the instrument about before it rests where it begins. */
const SETTLED_TICKS = 150;
/** While the driver is held: the host stops it 150 ms after it last heard of it. */
const DRIVE_REPEAT_MS = 40;
/**
 * Enters the cortex of most bones: 40 N is what bone of 1500 HU resists, subchondral bone has 600 to
 * 1200 (src/instruments/drilling_resistance.hpp).
 */
const START_THRUST_N = 40;
/** Nearer to the screen's plane than this a direction cannot turn the shaft (sine). */
const SMALLEST_TURN = 0.2;
/** To the right and up. */
const WAY: Readonly<Record<Direction, readonly [number, number]>> = {
  right: [1, 0],
  left: [-1, 0],
  up: [0, 1],
  down: [0, -1],
};

export interface HandHandlers {
  send(hand: Omit<HandMessage, "type" | "sequence">): void;
  /** @param by  degrees or newtons */
  moveWrist(axis: WristAxis, by: number): void;
  /** What people call a body. */
  label(body: string): string;
  say(hint: string): void;
  /** Closed skin is worked on: the hand goes on beyond where it was laid. */
  worksOnSkin(): boolean;
  /** Why what this hand holds would not go aside under the skin; undefined: it would. */
  whyHeldBySkin(hand: HandIndex): string | undefined;
  /** Why what this hand holds would not be laid where one looks; undefined: it would. */
  whyNotSwung(hand: HandIndex): string | undefined;
  /** Whether a fragment goes where a hand takes it by this instrument. */
  isJoystick(instrument: string): boolean;
  snapshot(): SnapshotMessage | undefined;
}

export class Hand {
  /** As what it says names it. */
  ledWith: LedWith = BY_KEYS;
  private readonly poses: [ToolPose, ToolPose] = [NOWHERE, NOWHERE];
  /** The hand that mouse and keys move. */
  private moved: HandIndex = 0;
  /** Whether the poses are those of this exercise: until its first snapshot nothing is sent. */
  private isPlaced = false;
  private last: SnapshotMessage | undefined;
  private thrustN = START_THRUST_N;
  private readonly held = new HeldDown();
  private changed = true;
  /** Push of a trigger that is pressed by degrees; else the hand's own. */
  private squeezedN: number | undefined;
  private pointer: { readonly x: number; readonly y: number } | undefined;
  private isCoarse = false;
  private enabled = false;
  private lastSentMs = -Infinity;
  private readonly abort = new AbortController();

  constructor(
    private readonly theatre: Theatre,
    private readonly handlers: HandHandlers,
  ) {
    const { signal } = this.abort;
    window.addEventListener(
      "blur",
      () => {
        this.releaseAll();
      },
      { signal },
    );
  }

  /** Which hand mouse and keys move. */
  get active(): HandIndex {
    return this.moved;
  }

  private get pose(): ToolPose {
    return this.poses[this.moved];
  }

  private set pose(pose: ToolPose) {
    this.poses[this.moved] = pose;
  }

  /** Whether it has taken over where this exercise begins. */
  get placed(): boolean {
    return this.isPlaced;
  }

  /** Another exercise: where its hands are, its first snapshot will say. */
  reset(): void {
    this.releaseAll();
    this.moved = 0;
    this.theatre.setActiveHand(0);
    this.isPlaced = false;
    this.last = undefined;
  }

  /** Mouse and keys move the other hand from now on; this one stops driving and stays. */
  switchHand(): void {
    this.releaseAll();
    this.frame(performance.now());
    this.moved = otherHand(this.moved);
    this.theatre.setActiveHand(this.moved);
    this.changed = true;
  }

  /**
   * Takes over where the host has what the hands hold: at first, after undo, and once the bone lets go
   * of it. While a hand moves freely it is the page that says where it wants to be.
   */
  see(s: SnapshotMessage): void {
    const before = this.last;
    this.last = s;
    if (!this.isPlaced && s.tick < SETTLED_TICKS) return;
    const anew = !this.isPlaced || before === undefined || s.undos !== before.undos;
    // What is driven came off or was put down: the held key was not meant for what is in the hand now.
    if (before !== undefined && s.hands[this.moved].item !== before.hands[this.moved].item)
      this.stopDriving();
    this.beginBeforeSkin(s, before);
    this.giveWay(s);
    for (const hand of [0, 1] as const) {
      const item = heldItem(s, hand);
      const had = before === undefined ? undefined : heldItem(before, hand);
      const isFreed = item?.body === "" && had?.item === item.item && had.body !== "";
      // What is driven goes its own way: a fragment is led from where it ends.
      const isDriven =
        this.leads(item) && (hand !== this.moved || this.driver !== "off" || had?.body === "");
      if (item === undefined ? !this.isPlaced : anew || isFreed || isDriven)
        this.takeOver(hand, item, isFreed);
    }
    this.isPlaced = true;
  }

  /** What is taken anew begins before closed skin. */
  private beginBeforeSkin(s: SnapshotMessage, before: SnapshotMessage | undefined): void {
    if (before === undefined || !this.handlers.worksOnSkin()) return;
    for (const hand of [0, 1] as const) {
      const { item } = s.hands[hand];
      const had = heldItem(before, hand);
      const isAnother =
        item !== before.hands[hand].item || heldItem(s, hand)?.instrument !== had?.instrument;
      if (item >= 0 && isAnother)
        this.hasPose(hand, begunBeforeSkin(this.poses[hand], had?.tip_mm));
    }
  }

  private giveWay(s: SnapshotMessage): void {
    for (const hand of [0, 1] as const) {
      const item = heldItem(s, hand);
      if (item === undefined || this.handlers.whyHeldBySkin(hand) === undefined) continue;
      this.hasPose(hand, givenWay(this.poses[hand], item.tip_mm));
    }
  }

  private hasPose(hand: HandIndex, pose: ToolPose): void {
    if (pose !== this.poses[hand]) this.changed = true;
    this.poses[hand] = pose;
  }

  /** Something gave before it, which a mouse does not let one feel: a key that is held leads it no farther. */
  feelGive(): void {
    const item = this.last === undefined ? undefined : heldItem(this.last, this.moved);
    this.held.letGoOf((action) => action.kind === "approach" && action.closer);
    if (item === undefined) return;
    this.pose = heldBackTo(this.pose, item.tip_mm, 0);
    this.changed = true;
  }

  private stopDriving(): void {
    this.held.letGoOf((action) => action.kind === "drive");
    this.changed = true;
  }

  private takeOver(hand: HandIndex, item: Item | undefined, isAtBone: boolean): void {
    const middleMm = this.theatre.middleMm();
    this.poses[hand] =
      item === undefined
        ? emptyHanded(middleMm, this.theatre.screenAxes().right, this.poses[0].shaft)
        : takenOver(item, middleMm, isAtBone || item.body !== "");
    this.changed = true;
  }

  setEnabled(on: boolean): void {
    this.enabled = on;
    if (!on) this.releaseAll();
    else this.changed = true;
  }

  /** As it was set [N]. */
  get thrust(): number {
    return this.thrustN;
  }

  get coarse(): boolean {
    return this.isCoarse;
  }

  toggleCoarse(): void {
    this.isCoarse = !this.isCoarse;
    this.handlers.say(this.isCoarse ? "Coarse steps: 1 mm, 5°." : "Fine steps: 0.1 mm, 0.5°.");
  }

  get driver(): HandMessage["driver"] {
    return this.held.driver;
  }

  changeThrust(byN: number): void {
    this.setThrust(this.thrustN + byN);
    this.handlers.say(`Push of the hand: ${this.thrustN} N`);
  }

  setThrust(n: number): void {
    this.thrustN = Math.min(MAX_THRUST_N, Math.max(0, n));
    this.changed = true;
  }

  /** @param n  push of a trigger; undefined once it is let go */
  squeeze(n: number | undefined): void {
    if (this.squeezedN === n) return;
    this.squeezedN = n;
    this.changed = true;
  }

  /**
   * @param repeats  the key was down before: held through a lost connection it does not drive on
   * @return whether the key is one of the hand's
   */
  keyDown(press: KeyPress, nowMs: number, repeats: boolean): boolean {
    const action = heldAction(press);
    if (action === undefined) return false;
    if (!repeats) this.hold(press.code, action, nowMs);
    return true;
  }

  /**
   * Something is held down: a key, a button of the page or of a gamepad.
   * @param holder  by which it is let go
   * @return whether the hand does it
   */
  hold(holder: string, action: HeldAction, nowMs: number): boolean {
    if (!this.enabled || this.held.has(holder)) return false;
    const hint = this.hint(action.kind);
    if (hint !== undefined) {
      this.handlers.say(hint);
      return false;
    }
    this.held.begin(holder, action, nowMs);
    if (action.kind === "drive") this.driveNow(nowMs);
    return true;
  }

  letGo(holder: string, nowMs: number): void {
    const action = this.held.letGo(holder, nowMs, this.isCoarse, this.go);
    if (action?.kind === "drive") this.driveNow(nowMs);
  }

  /** The driver starts and stops at once, not with the next picture. */
  private driveNow(nowMs: number): void {
    this.changed = true;
    this.frame(nowMs);
  }

  releaseAll(): void {
    this.held.clear();
    this.pointer = undefined;
    this.squeezedN = undefined;
    this.changed = true;
  }

  /** Once per frame: what is held goes on, and the newest state is sent if it is new. */
  frame(nowMs: number): void {
    if (!this.enabled || !this.isPlaced) return;
    this.held.walk(nowMs, this.isCoarse, this.go);
    this.follow();
    const driver = this.driver;
    const repeatMs = driver === "off" ? REPEAT_MS : DRIVE_REPEAT_MS;
    if (!this.changed && nowMs - this.lastSentMs < repeatMs) return;
    this.changed = false;
    this.lastSentMs = nowMs;
    this.handlers.send({
      hand: this.moved,
      tip_mm: tipTarget(this.pose),
      shaft: this.pose.shaft,
      thrust_n: driver === "forward" ? (this.squeezedN ?? this.thrustN) : 0,
      driver,
      guidance: "planned",
    });
  }

  dispose(): void {
    this.abort.abort();
  }

  private hint(kind: HeldAction["kind"]): string | undefined {
    const snapshot = this.handlers.snapshot();
    if (snapshot === undefined || kind === "orbit" || kind === "move_wrist") return undefined;
    const item = heldItem(snapshot, this.moved);
    if (kind === "drive" && item !== undefined) return undefined;
    if (kind === "move_tip" || kind === "turn_shaft") {
      const why = this.handlers.whyHeldBySkin(this.moved);
      if (why !== undefined) return why;
    }
    const label = (body: string): string => this.handlers.label(body);
    return whyItKeepsStill(item, label, this.leads(item), this.ledWith);
  }

  private leadsNow(): boolean {
    return this.last !== undefined && this.leads(heldItem(this.last, this.moved));
  }

  private leads(item: Item | undefined): boolean {
    return item !== undefined && item.body !== "" && this.handlers.isJoystick(item.instrument);
  }

  /** On by so much. */
  private readonly go = (action: SteppedAction, by: number): void => {
    switch (action.kind) {
      case "move_tip":
        this.slide(scaled(this.onScreen(WAY[action.to]), by));
        break;
      case "turn_shaft":
        this.turn(this.onScreen(WAY[action.to]), by);
        break;
      case "approach":
        this.pose = approachedBy(
          this.pose,
          action.closer ? -by : by,
          this.handlers.worksOnSkin() ? DEEPEST_MM : 0,
        );
        break;
      case "move_wrist":
        this.handlers.moveWrist(action.axis, action.sign * by);
        return;
      case "orbit": {
        const [right, up] = WAY[action.to];
        this.theatre.orbit(by * right, -by * up);
        return;
      }
    }
    this.changed = true;
  };

  private onScreen([right, up]: readonly [number, number]): Vec3 {
    const axes = this.theatre.screenAxes();
    return add(scaled(axes.right, right), scaled(axes.up, up));
  }

  /** Moves the tip in the screen's plane; while it touches, along the bone's surface. */
  private slide(delta: Vec3): void {
    const moved = movedBy(this.pose, delta);
    this.pose = moved;
    if (moved.approachMm > 0 || this.leadsNow()) return;
    const onBone = this.theatre.bonePointBehind(moved.anchorMm);
    if (onBone === undefined) return;
    if (length(subtract(onBone, moved.anchorMm)) > FOLLOW_SURFACE_MM + length(delta)) return;
    this.pose = { ...moved, anchorMm: onBone };
  }

  /** Turns the shaft so that its tail goes `towards` (a unit vector in the screen's plane). */
  private turn(towards: Vec3, angleRad: number): void {
    const axis = cross(this.pose.shaft, towards);
    if (length(axis) < SMALLEST_TURN) return;
    this.pose = turnedBy(this.pose, normalized(axis), angleRad);
  }

  private follow(): void {
    if (this.pointer === undefined) return;
    const { x, y } = this.pointer;
    this.pointer = undefined;
    const bone = this.leadsNow() ? undefined : this.theatre.bonePointAt(x, y);
    const anchorMm = bone ?? this.theatre.planePointAt(x, y, this.pose.anchorMm);
    // What presses on skin goes on pressing.
    this.pose = { ...this.pose, anchorMm, approachMm: Math.min(0, this.pose.approachMm) };
    this.changed = true;
  }

  /** Whether it could be placed freely now; says nothing. */
  get canBePlaced(): boolean {
    return this.enabled && this.isPlaced && this.hint("move_tip") === undefined;
  }

  /** Where its tip is asked to be, in Patient [mm]. */
  get tipMm(): Vec3 {
    return tipTarget(this.pose);
  }

  /** The tip here, in Patient [mm], the shaft (unit) thus: by something that has places, as a controller. */
  place(tipMm: Vec3, shaft: Vec3): void {
    this.pose = { anchorMm: subtract(tipMm, shaft), approachMm: 1, shaft };
    this.changed = true;
  }

  /** Whether it can be placed freely now; says why not. */
  isFree(): boolean {
    if (!this.enabled || !this.isPlaced) return false;
    const hint = this.hint("move_tip");
    if (hint !== undefined) this.handlers.say(hint);
    return hint === undefined;
  }

  /** Lays the tip onto the bone under this point of the page, with the next frame. */
  moveTipTo(x: number, y: number): void {
    this.pointer = { x, y };
  }

  /** Where its tip is asked to be, on the page. */
  tipOnPage(): { readonly x: number; readonly y: number } {
    return this.theatre.pagePoint(this.pose.anchorMm);
  }

  /** Moves the tip on the screen [mm]. */
  moveTipBy(right: number, up: number): void {
    this.slide(this.onScreen([right, up]));
    this.changed = true;
  }

  /** Turns the shaft's tail on the screen [rad]. */
  turnShaftBy(right: number, up: number): void {
    const towards = this.onScreen([right, up]);
    const angle = length(towards);
    if (angle > 0) this.turn(scaled(towards, 1 / angle), angle);
    this.changed = true;
  }

  /** The same, by a way of the pointer [CSS px], down positive. */
  turnShaftByPixels(dx: number, dy: number): void {
    this.turnShaftBy(dx * TURN_RAD_PER_PX, -dy * TURN_RAD_PER_PX);
  }

  /** Lays the tip onto the bone in the middle of the picture and the shaft along the sight. */
  aimAlongSight(): void {
    if (!this.isFree()) return;
    const why = this.handlers.whyNotSwung(this.moved);
    if (why !== undefined) {
      this.handlers.say(why);
      return;
    }
    const { canvas } = this.theatre;
    const box = canvas.getBoundingClientRect();
    const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
    const anchorMm = this.theatre.bonePointAt(x, y);
    if (anchorMm === undefined) {
      this.handlers.say("No bone lies in the middle of the picture: turn it, Ctrl + arrows.");
      return;
    }
    const { right, up } = this.theatre.screenAxes();
    this.pose = { anchorMm, approachMm: 0, shaft: normalized(cross(right, up)) };
    this.changed = true;
  }
}

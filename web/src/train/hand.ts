// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Mouse and keys become one of the two hands: where it holds its instrument, how it pushes, the driver;
// the other hand stays where it is. It asks; which way the hand goes and where the instrument really is,
// the host says.
import {
  heldAction,
  heldItem,
  MAX_THRUST_N,
  otherHand,
  whyItKeepsStill,
  type Direction,
  type HandIndex,
  type HeldAction,
  type KeyPress,
  type WristAxis,
} from "../operation";
import type { HandMessage, Item, SnapshotMessage, Vec3 } from "../protocol";
import type { Theatre } from "../theatre";
import {
  add,
  approachedBy,
  cross,
  dot,
  length,
  MAX_APPROACH_MM,
  movedBy,
  normalized,
  scaled,
  stepsAfter,
  subtract,
  tipTarget,
  turnedBy,
  type ToolPose,
} from "../tool_placement";

const MOVE_STEP_MM = 0.1;
const TURN_STEP_RAD = (0.5 * Math.PI) / 180;
const ORBIT_STEP_RAD = (2 * Math.PI) / 180;
const TURN_RAD_PER_PX = (0.25 * Math.PI) / 180;
/** A fine step never jumps to another bone that happens to lie on the line of sight. */
const FOLLOW_SURFACE_MM = 3;
const WRIST_STEP = 1;
/** An empty hand begins so far beside the middle, to the right of the screen. */
const BESIDE_MM = 30;
/** A still hand is sent again after this long: the host pauses when it hears nothing [ms]. */
const REPEAT_MS = 250;
/** While the driver is held: the host stops it 150 ms after it last heard of it. */
const DRIVE_REPEAT_MS = 40;
const START_THRUST_N = 25;
/** Nearer to the screen's plane than this a direction cannot turn the shaft (sine). */
const SMALLEST_TURN = 0.2;

const NOWHERE: ToolPose = { anchorMm: [0, 0, 0], approachMm: MAX_APPROACH_MM, shaft: [0, 0, 1] };

interface Held {
  readonly action: HeldAction;
  readonly sinceMs: number;
  done: number;
}

export interface HandHandlers {
  send(hand: Omit<HandMessage, "type" | "sequence">): void;
  /** @param by  degrees or newtons */
  moveWrist(axis: WristAxis, by: number): void;
  /** What people call a body. */
  label(body: string): string;
  say(hint: string): void;
  snapshot(): SnapshotMessage | undefined;
}

export class Hand {
  private readonly poses: [ToolPose, ToolPose] = [NOWHERE, NOWHERE];
  /** The hand that mouse and keys move. */
  private moved: HandIndex = 0;
  /** Whether the poses are those of this exercise: until its first snapshot nothing is sent. */
  private isPlaced = false;
  private last: SnapshotMessage | undefined;
  private thrustN = START_THRUST_N;
  private readonly held = new Map<string, Held>();
  private changed = true;
  private drag: "move" | "turn" | undefined;
  private pointerX = 0;
  private pointerY = 0;
  private pointerMoved = false;
  private enabled = false;
  private lastSentMs = -Infinity;
  private readonly abort = new AbortController();

  constructor(
    private readonly theatre: Theatre,
    private readonly handlers: HandHandlers,
  ) {
    const { signal } = this.abort;
    const { canvas } = theatre;
    canvas.addEventListener(
      "pointerdown",
      (e) => {
        this.pointerDown(e);
      },
      { signal },
    );
    canvas.addEventListener(
      "pointermove",
      (e) => {
        this.pointerMove(e);
      },
      { signal },
    );
    canvas.addEventListener(
      "pointerup",
      (e) => {
        this.pointerUp(e);
      },
      { signal },
    );
    canvas.addEventListener(
      "pointercancel",
      (e) => {
        this.pointerUp(e);
      },
      { signal },
    );
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
    const anew = before === undefined || !this.isPlaced || s.undos !== before.undos;
    // What is driven came off or was put down: the held key was not meant for what is in the hand now.
    if (before !== undefined && s.hands[this.moved].item !== before.hands[this.moved].item)
      this.stopDriving();
    for (const hand of [0, 1] as const) {
      const item = heldItem(s, hand);
      const had = before === undefined ? undefined : heldItem(before, hand);
      const isFreed = item?.body === "" && had?.item === item.item && had.body !== "";
      if (item === undefined ? !this.isPlaced : anew || isFreed) this.takeOver(hand, item, isFreed);
    }
    this.isPlaced = true;
  }

  private stopDriving(): void {
    for (const [code, { action }] of this.held) if (action.kind === "drive") this.held.delete(code);
    this.changed = true;
  }

  private takeOver(hand: HandIndex, item: Item | undefined, isAtBone: boolean): void {
    const middle = this.theatre.middleMm();
    if (item === undefined) {
      const beside = scaled(this.theatre.screenAxes().right, BESIDE_MM);
      const shaft = normalized(this.poses[0].shaft);
      this.poses[hand] = { anchorMm: add(middle, beside), approachMm: MAX_APPROACH_MM, shaft };
    } else {
      const shaft = normalized(item.shaft);
      const above = isAtBone || item.body !== "" ? 0 : dot(subtract(item.tip_mm, middle), shaft);
      // Drawn back from the level of what is operated on, so that it can be advanced to there.
      const approachMm = Math.min(MAX_APPROACH_MM, Math.max(0, above));
      const anchorMm = subtract(item.tip_mm, scaled(shaft, approachMm));
      this.poses[hand] = { anchorMm, approachMm, shaft };
    }
    this.changed = true;
  }

  setEnabled(on: boolean): void {
    this.enabled = on;
    if (!on) this.releaseAll();
    else this.changed = true;
  }

  get thrust(): number {
    return this.thrustN;
  }

  get driver(): HandMessage["driver"] {
    for (const { action } of this.held.values()) {
      if (action.kind === "drive") return action.driver;
    }
    return "off";
  }

  changeThrust(byN: number): void {
    this.thrustN = Math.min(MAX_THRUST_N, Math.max(0, this.thrustN + byN));
    this.changed = true;
    this.handlers.say(`Push of the hand: ${this.thrustN} N`);
  }

  /**
   * @param repeats  the key was down before: held through a lost connection it does not drive on
   * @return whether the key is one of the hand's
   */
  keyDown(press: KeyPress, nowMs: number, repeats: boolean): boolean {
    const action = heldAction(press);
    if (action === undefined) return false;
    if (!this.enabled || repeats || this.held.has(press.code)) return true;
    const hint = this.hint(action.kind);
    if (hint !== undefined) {
      this.handlers.say(hint);
      return true;
    }
    this.held.set(press.code, { action, sinceMs: nowMs, done: 0 });
    if (action.kind === "drive") this.driveNow(nowMs);
    return true;
  }

  keyUp(code: string, nowMs: number): void {
    const key = this.held.get(code);
    if (key === undefined) return;
    // A tap between two frames still counts.
    this.walk(key, nowMs);
    this.held.delete(code);
    if (key.action.kind === "drive") this.driveNow(nowMs);
  }

  /** The driver starts and stops at once, not with the next picture. */
  private driveNow(nowMs: number): void {
    this.changed = true;
    this.frame(nowMs);
  }

  releaseAll(): void {
    this.held.clear();
    this.drag = undefined;
    this.changed = true;
  }

  /** Once per frame: what is held goes on, and the newest state is sent if it is new. */
  frame(nowMs: number): void {
    if (!this.enabled || !this.isPlaced) return;
    for (const key of this.held.values()) this.walk(key, nowMs);
    if (this.pointerMoved) {
      this.pointerMoved = false;
      if (this.drag === "move") this.follow();
    }
    const driver = this.driver;
    const repeatMs = driver === "off" ? REPEAT_MS : DRIVE_REPEAT_MS;
    if (!this.changed && nowMs - this.lastSentMs < repeatMs) return;
    this.changed = false;
    this.lastSentMs = nowMs;
    this.handlers.send({
      hand: this.moved,
      tip_mm: tipTarget(this.pose),
      shaft: this.pose.shaft,
      thrust_n: driver === "forward" ? this.thrustN : 0,
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
    return whyItKeepsStill(item, (body) => this.handlers.label(body));
  }

  private walk(key: Held, nowMs: number): void {
    const { action } = key;
    if (action.kind === "drive") return;
    const due = stepsAfter((nowMs - key.sinceMs) / 1000);
    const steps = due - key.done;
    if (steps <= 0) return;
    key.done = due;
    switch (action.kind) {
      case "move_tip":
        this.slide(action.to, steps * MOVE_STEP_MM);
        break;
      case "turn_shaft":
        this.turn(this.onScreen(action.to), steps * TURN_STEP_RAD);
        break;
      case "approach":
        this.pose = approachedBy(this.pose, (action.closer ? -1 : 1) * steps * MOVE_STEP_MM);
        break;
      case "move_wrist":
        this.handlers.moveWrist(action.axis, action.sign * steps * WRIST_STEP);
        return;
      case "orbit": {
        const angle = steps * ORBIT_STEP_RAD;
        const right = action.to === "right" ? angle : action.to === "left" ? -angle : 0;
        const up = action.to === "up" ? angle : action.to === "down" ? -angle : 0;
        this.theatre.orbit(right, -up);
        return;
      }
    }
    this.changed = true;
  }

  private onScreen(to: Direction): Vec3 {
    const { right, up } = this.theatre.screenAxes();
    switch (to) {
      case "right":
        return right;
      case "left":
        return scaled(right, -1);
      case "up":
        return up;
      case "down":
        return scaled(up, -1);
    }
  }

  /** Moves the tip in the screen's plane; while it touches, along the bone's surface. */
  private slide(to: Direction, mm: number): void {
    const moved = movedBy(this.pose, scaled(this.onScreen(to), mm));
    this.pose = moved;
    if (moved.approachMm > 0) return;
    const onBone = this.theatre.bonePointBehind(moved.anchorMm);
    if (onBone === undefined) return;
    if (length(subtract(onBone, moved.anchorMm)) > FOLLOW_SURFACE_MM + mm) return;
    this.pose = { ...moved, anchorMm: onBone };
  }

  /** Turns the shaft so that its tail goes `towards` (a unit vector in the screen's plane). */
  private turn(towards: Vec3, angleRad: number): void {
    const axis = cross(this.pose.shaft, towards);
    if (length(axis) < SMALLEST_TURN) return;
    this.pose = turnedBy(this.pose, normalized(axis), angleRad);
  }

  private follow(): void {
    const bone = this.theatre.bonePointAt(this.pointerX, this.pointerY);
    const anchorMm =
      bone ?? this.theatre.planePointAt(this.pointerX, this.pointerY, this.pose.anchorMm);
    this.pose = { ...this.pose, anchorMm, approachMm: 0 };
    this.changed = true;
  }

  private pointerDown(event: PointerEvent): void {
    if (event.button !== 0 || !this.enabled) return;
    this.theatre.canvas.focus({ preventScroll: true });
    const hint = this.hint(event.shiftKey ? "turn_shaft" : "move_tip");
    if (hint !== undefined) {
      this.handlers.say(hint);
      return;
    }
    this.theatre.canvas.setPointerCapture(event.pointerId);
    this.drag = event.shiftKey ? "turn" : "move";
    this.pointerX = event.clientX;
    this.pointerY = event.clientY;
    this.pointerMoved = true;
  }

  private pointerMove(event: PointerEvent): void {
    if (this.drag === undefined) return;
    if (this.drag === "turn") {
      const { right, up } = this.theatre.screenAxes();
      const dx = event.clientX - this.pointerX;
      const dy = event.clientY - this.pointerY;
      const towards = add(scaled(right, dx), scaled(up, -dy));
      const pixels = length(towards);
      if (pixels > 0) this.turn(scaled(towards, 1 / pixels), pixels * TURN_RAD_PER_PX);
      this.changed = true;
    }
    this.pointerX = event.clientX;
    this.pointerY = event.clientY;
    this.pointerMoved = true;
  }

  private pointerUp(event: PointerEvent): void {
    if (event.button !== 0 || this.drag === undefined) return;
    if (this.pointerMoved && this.drag === "move") this.follow();
    this.pointerMoved = false;
    this.drag = undefined;
  }
}

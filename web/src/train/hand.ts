// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Mouse and keys become the hand: where it holds the instrument, how it pushes, the driver. It asks;
// where the instrument really is, the host says.
import {
  heldAction,
  MAX_THRUST_N,
  whyNot,
  type Direction,
  type HeldAction,
  type KeyPress,
} from "../operation";
import type { SnapshotMessage, ToolMessage, Vec3 } from "../protocol";
import type { Theatre } from "../theatre";
import {
  add,
  approachedBy,
  cross,
  length,
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
const START_APPROACH_MM = 30;
/** A still hand is sent again after this long: the host pauses when it hears nothing [ms]. */
const REPEAT_MS = 250;
/** While the driver is held: the host stops it 150 ms after it last heard of it. */
const DRIVE_REPEAT_MS = 40;
/** The hand moves at most this fast, and farther ways lead over the bone, not along it. */
const HAND_MM_PER_S = 350;
const SLIDE_MM = 4;
const LIFT_MM = 18;
const START_THRUST_N = 25;
/** Nearer to the screen's plane than this a direction cannot turn the shaft (sine). */
const SMALLEST_TURN = 0.2;

interface Held {
  readonly action: HeldAction;
  readonly sinceMs: number;
  done: number;
}

export interface HandHandlers {
  send(tool: Omit<ToolMessage, "type" | "sequence">): void;
  say(hint: string): void;
  snapshot(): SnapshotMessage | undefined;
}

export class Hand {
  private pose: ToolPose = { anchorMm: [0, 0, 0], approachMm: START_APPROACH_MM, shaft: [0, 0, 1] };
  private thrustN = START_THRUST_N;
  private readonly held = new Map<string, Held>();
  private changed = true;
  private drag: "move" | "turn" | undefined;
  private pointerX = 0;
  private pointerY = 0;
  private pointerMoved = false;
  private enabled = false;
  private lastSentMs = -Infinity;
  private lastFrameMs = -Infinity;
  /** Where the tip still has to go through, the end last. */
  private way: Vec3[] = [];
  private tip: Vec3 = [0, 0, 0];
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

  /** Lifts the instrument off, above the wrist, as at the beginning. */
  reset(startMm: Vec3, shaft: Vec3): void {
    this.pose = { anchorMm: startMm, approachMm: START_APPROACH_MM, shaft: normalized(shaft) };
    this.releaseAll();
    this.tip = tipTarget(this.pose);
    this.way = [];
    this.changed = true;
  }

  /** Takes the instrument over from where the host has it. */
  takeOver(s: SnapshotMessage): void {
    this.pose = { anchorMm: s.tip_mm, approachMm: 0, shaft: normalized(s.shaft) };
    this.tip = s.tip_mm;
    this.way = [];
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

  get driver(): ToolMessage["driver"] {
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
    if (!this.enabled) return;
    for (const key of this.held.values()) this.walk(key, nowMs);
    if (this.pointerMoved) {
      this.pointerMoved = false;
      if (this.drag === "move") this.follow();
    }
    this.carry(Math.min(0.1, Math.max(0, (nowMs - this.lastFrameMs) / 1000)));
    this.lastFrameMs = nowMs;
    const driver = this.driver;
    const repeatMs = driver === "off" ? REPEAT_MS : DRIVE_REPEAT_MS;
    if (!this.changed && nowMs - this.lastSentMs < repeatMs) return;
    this.changed = false;
    this.lastSentMs = nowMs;
    this.handlers.send({
      tip_mm: this.tip,
      shaft: this.pose.shaft,
      thrust_n: driver === "forward" ? this.thrustN : 0,
      driver,
    });
  }

  /** Moves the tip on its way as a hand does: short ways straight, longer ones lifted off the bone. */
  private carry(seconds: number): void {
    const target = tipTarget(this.pose);
    const end = this.way.at(-1) ?? this.tip;
    const jump = length(subtract(target, end));
    if (jump > 0) {
      this.changed = true;
      if (this.way.length > 0 || jump > SLIDE_MM) {
        const lift = scaled(this.pose.shaft, LIFT_MM);
        // In flight already: the rest of the way leads to where the hand is wanted now.
        const first = this.way.length === 0 ? add(this.tip, lift) : this.way[0];
        const lifting = first !== undefined && (this.way.length === 0 || this.way.length === 3);
        this.way = lifting ? [first, add(target, lift), target] : [add(target, lift), target];
        if (this.pose.approachMm > 0) this.way = [target];
      } else {
        this.tip = target;
        return;
      }
    }
    let reach = HAND_MM_PER_S * seconds;
    while (reach > 0) {
      const next = this.way[0];
      if (next === undefined) return;
      this.changed = true;
      const ahead = subtract(next, this.tip);
      const mm = length(ahead);
      if (mm > reach) {
        this.tip = add(this.tip, scaled(ahead, reach / mm));
        return;
      }
      this.tip = next;
      reach -= mm;
      this.way.shift();
    }
  }

  dispose(): void {
    this.abort.abort();
  }

  private hint(kind: string): string | undefined {
    const snapshot = this.handlers.snapshot();
    return snapshot === undefined ? undefined : whyNot(kind, snapshot);
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

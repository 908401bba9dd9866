// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The first ninety seconds: six things that hands must know, each ticked by what really happened, in
// whatever order. Pure.
import type { Vec3 } from "../protocol";

export const TASKS = ["look", "move", "aim", "drive", "shot", "undo"] as const;
export type Task = (typeof TASKS)[number];

/** What there is to see of what the person does. */
export interface Observation {
  /** Right of the screen, in Patient. */
  readonly screenRight: Vec3;
  readonly screenUp: Vec3;
  /** Of what the hand holds, free of bone; undefined while it is none. */
  readonly free: { readonly tip: Vec3; readonly shaft: Vec3 } | undefined;
  /** How deep it is in bone, 0 outside [mm]. */
  readonly depthMm: number;
  readonly shots: number;
  readonly undos: number;
}

/** So much was meant. */
const LOOK_DEG = 10;
const MOVE_MM = 3;
const AIM_DEG = 5;
const DRIVE_MM = 1;

function degreesBetween(a: Vec3, b: Vec3): number {
  const cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return (180 / Math.PI) * Math.acos(Math.min(1, Math.max(-1, cosine)));
}

export class FirstTouch {
  private readonly done = new Set<Task>();
  private first: Observation | undefined;
  private firstFree: Observation["free"];

  get finished(): boolean {
    return this.done.size === TASKS.length;
  }

  /** What is to be tried next. */
  get current(): Task | undefined {
    return TASKS.find((task) => !this.done.has(task));
  }

  isDone(task: Task): boolean {
    return this.done.has(task);
  }

  /** @return whether something was done that was not before */
  observe(now: Observation): boolean {
    this.first ??= now;
    this.firstFree ??= now.free;
    const before = this.done.size;
    const { first, firstFree } = this;
    const turned = Math.max(
      degreesBetween(first.screenRight, now.screenRight),
      degreesBetween(first.screenUp, now.screenUp),
    );
    if (turned > LOOK_DEG) this.done.add("look");
    if (firstFree !== undefined && now.free !== undefined) {
      const [a, b] = [firstFree.tip, now.free.tip];
      if (Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > MOVE_MM) this.done.add("move");
      if (degreesBetween(firstFree.shaft, now.free.shaft) > AIM_DEG) this.done.add("aim");
    }
    if (now.depthMm > DRIVE_MM) this.done.add("drive");
    if (now.shots > first.shots) this.done.add("shot");
    if (now.undos > first.undos) this.done.add("undo");
    return this.done.size > before;
  }
}

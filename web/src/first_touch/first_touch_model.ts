// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The first ninety seconds: a few things that hands must know, each ticked by what really happened, in
// whatever order. Which they are is a lesson's affair. Pure.
import type { Vec3 } from "../protocol";

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
  /** That mouse and keys move. */
  readonly hand: number;
  /** The scope is in one. */
  readonly inJoint: boolean;
  /** In a joint, whatever hand holds it; undefined before: outside it neither leans nor looks. */
  readonly scope: ScopeSeen | undefined;
}

export interface ScopeSeen {
  readonly tip: Vec3;
  readonly shaft: Vec3;
  /** How the shaft and its camera head are turned. */
  readonly shaftDeg: number;
  readonly cameraDeg: number;
}

export interface Task {
  readonly id: string;
  readonly name: string;
  /** How, by each way of leading. */
  readonly mouse: string;
  readonly finger: string;
  readonly keys: string;
  readonly gamepad: string;
  /** So much was meant. */
  isDone(first: Observation, now: Observation): boolean;
}

export interface Lesson {
  /** Under which a device remembers that it was gone through. */
  readonly id: string;
  readonly tasks: readonly Task[];
  /** It leaves a bone that is drilled: an operation in earnest begins anew. */
  readonly spoils: boolean;
}

export function degreesBetween(a: Vec3, b: Vec3): number {
  const cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return (180 / Math.PI) * Math.acos(Math.min(1, Math.max(-1, cosine)));
}

export class FirstTouch {
  private readonly done = new Set<string>();
  private first: Observation | undefined;

  constructor(readonly lesson: Lesson) {}

  get finished(): boolean {
    return this.done.size === this.lesson.tasks.length;
  }

  /** What is to be tried next. */
  get current(): string | undefined {
    return this.lesson.tasks.find(({ id }) => !this.done.has(id))?.id;
  }

  isDone(task: string): boolean {
    return this.done.has(task);
  }

  /** @return whether something was done that was not before */
  observe(now: Observation): boolean {
    const { first = now } = this;
    // What was not there at first counts from when it is.
    this.first = { ...first, free: first.free ?? now.free, scope: first.scope ?? now.scope };
    const before = this.done.size;
    for (const task of this.lesson.tasks) {
      if (task.isDone(this.first, now)) this.done.add(task.id);
    }
    return this.done.size > before;
  }
}

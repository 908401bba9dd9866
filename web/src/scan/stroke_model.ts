// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The stroke that was painted last, so that it can be laid elsewhere.
import type { Vec3 } from "../protocol";
import type { LabelPaint } from "./paint_model";
import { along } from "./planes_model";

export interface StrokeKind {
  readonly radiusMm: number;
  /** What is painted; 0 erases. */
  readonly label: number;
  /** Changes this label alone; any where undefined. */
  readonly only: number | undefined;
  /** It is a marker: its bone's border is found from it. */
  readonly grows: boolean;
}

export class Stroke {
  private points: Vec3[];
  /** Of the change that it made, if it made one. */
  private mark: object | undefined;
  private readonly before: object | undefined;

  constructor(
    readonly kind: StrokeKind,
    private readonly paint: LabelPaint,
    at: Vec3,
  ) {
    this.points = [at];
    this.before = paint.latest;
    paint.begin();
    this.draw(at, at);
  }

  goOn(to: Vec3): void {
    this.draw(this.points.at(-1) ?? to, to);
    this.points.push(to);
  }

  /** It is whole; later changes are others. */
  end(): void {
    this.paint.end();
    const { latest } = this.paint;
    if (latest !== this.before) this.mark = latest;
  }

  /** Nothing was changed since, but for what was found from it. */
  get isLatest(): boolean {
    return this.mark !== undefined && this.mark === this.paint.latest;
  }

  get middle(): Vec3 {
    const sum = this.points.reduce<Vec3>((all, one) => along(all, 1, one), [0, 0, 0]);
    return along([0, 0, 0], 1 / this.points.length, sum);
  }

  /** What it did, and what was found from it, is laid off from where it was. Until endMove() it may change. */
  moveBy(offset: Vec3): void {
    this.paint.rewind();
    this.paint.insteadOfLatest();
    let last: Vec3 | undefined;
    for (const point of this.points) {
      const at = along(point, 1, offset);
      this.draw(last ?? at, at);
      last = at;
    }
  }

  beginMove(): void {
    this.paint.begin();
  }

  endMove(offset: Vec3): void {
    this.points = this.points.map((point) => along(point, 1, offset));
    this.end();
  }

  private draw(from: Vec3, to: Vec3): void {
    const { radiusMm, label, only } = this.kind;
    this.paint.stroke(from, to, radiusMm, label, only);
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The line of a cut while it is laid: dragged, or end by end with Enter at the crosshair. Once it is whole it stays
// until the cut is made or dropped.
import type { Vec3 } from "../protocol";
import { isLongEnough, type CutLine } from "./cut_line_model";

export class CutTool {
  private a: Vec3 | undefined;
  private b: Vec3 | undefined;
  private away: Vec3 = [0, 0, 1];
  private isDragged = false;

  /** The line that a person has laid; undefined while it is being laid. */
  get whole(): CutLine | undefined {
    const { a, b, away } = this;
    return a === undefined || b === undefined || this.isDragged ? undefined : { a, b, away };
  }

  /** As it is to be drawn: laid by keys, its second end is still at the crosshair. */
  shown(cross: Vec3, away: Vec3): CutLine | undefined {
    const { a, b } = this;
    if (a === undefined) return undefined;
    return b === undefined ? { a, b: cross, away } : { a, b, away: this.away };
  }

  drop(): void {
    this.a = this.b = undefined;
    this.isDragged = false;
  }

  /** @return whether the line is whole now */
  press(mm: Vec3, away: Vec3, phase: "down" | "move" | "up"): boolean {
    if (phase === "down") {
      this.a = this.b = mm;
      this.away = away;
      this.isDragged = true;
      return false;
    }
    if (!this.isDragged) return false;
    this.b = mm;
    if (phase === "move") return false;
    this.isDragged = false;
    return this.keepOrDrop();
  }

  /** Lays an end. @return whether the line is whole now */
  addEnd(mm: Vec3, away: Vec3): boolean {
    if (this.a === undefined || this.b !== undefined) {
      this.drop();
      this.a = mm;
      return false;
    }
    this.b = mm;
    this.away = away;
    return this.keepOrDrop();
  }

  private keepOrDrop(): boolean {
    const line = this.whole;
    if (line !== undefined && isLongEnough(line)) return true;
    this.drop();
    return false;
  }
}

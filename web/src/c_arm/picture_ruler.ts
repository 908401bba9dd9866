// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The ruler over the monitor's picture: two points by clicks, or by a cross that keys move.
import { make, setText } from "../dom";
import type { CArmPicture } from "../protocol";
import type { Monitor } from "./monitor";
import {
  keyStep,
  nudgedPoint,
  rulerMm,
  rulerText,
  withPoint,
  type PicturePoint,
  type Ruler,
} from "./ruler_model";

const RULER_KEYS = "move the cross by arrows (with Shift far) and set a point by Enter.";

export class PictureRuler {
  /** What was measured. */
  readonly reading = make("p.c-arm-ruled", { role: "status" });
  private isOn = false;
  private points: Ruler = [];
  /** Where the cross is, once keys have moved it. */
  private cross: PicturePoint | undefined;

  /** @param picture  that is shown. @param changed  it is to be drawn anew */
  constructor(
    private readonly monitor: Monitor,
    private readonly picture: () => CArmPicture | undefined,
    private readonly changed: () => void,
  ) {
    monitor.onPoint = (point) => {
      if (!this.isOn) return;
      this.cross = undefined;
      this.setPoint(point);
    };
    monitor.onKey = (event) => this.isOn && this.takeKey(event);
  }

  get drawn(): { readonly ruler: Ruler; readonly cross: PicturePoint | undefined } {
    return { ruler: this.points, cross: this.cross };
  }

  get on(): boolean {
    return this.isOn;
  }

  /** @return how it is used, when it comes on */
  toggle(): string | undefined {
    this.isOn = !this.isOn;
    this.points = [];
    this.cross = undefined;
    this.monitor.takeKeys(this.isOn ? RULER_KEYS : undefined);
    this.changed();
    return this.isOn ? `Ruler: click two points of the picture, or ${RULER_KEYS}` : undefined;
  }

  /** Another picture: what was measured on the last one says nothing of it. */
  forget(): void {
    this.points = [];
  }

  showReading(): void {
    const picture = this.picture();
    const mm = picture === undefined ? undefined : rulerMm(this.points, picture);
    setText(this.reading, mm === undefined ? "" : rulerText(mm));
  }

  private setPoint(point: PicturePoint): void {
    this.points = withPoint(this.points, point);
    this.changed();
  }

  private takeKey({ key, shiftKey }: KeyboardEvent): boolean {
    const picture = this.picture();
    if (picture === undefined) return false;
    const cross = this.cross ?? { x: 0.5, y: 0.5 };
    if (key === "Enter") {
      this.setPoint(cross);
      return true;
    }
    const step = keyStep(key, shiftKey);
    if (step === undefined) return false;
    this.cross = nudgedPoint(cross, step.right / picture.width, step.down / picture.height);
    this.changed();
    return true;
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture that is asked about, and over it, once the truth is told, the outlines of bone and
// screw.
import { drawPicture } from "../c_arm";
import { make, makeSvg } from "../dom";
import type { CArmPicture, QuizViewTruth } from "../protocol";
import { polygonPoints } from "./quiz_model";

export class QuizPicture {
  readonly element: HTMLElement;
  private readonly canvas = make("canvas", { role: "img", "aria-label": "No picture yet" });
  private readonly outlines = makeSvg("svg", { class: "quiz-outlines", "aria-hidden": "true" });
  private readonly waiting = make("p.quiz-waiting", { role: "status" });
  private shown: CArmPicture | undefined;
  private name = "";
  private inverted = false;

  constructor() {
    this.element = make("div.quiz-frame", {}, this.canvas, this.outlines, this.waiting);
    new ResizeObserver(() => {
      this.redraw();
    }).observe(this.canvas);
  }

  show(picture: CArmPicture | undefined, name: string): void {
    this.shown = picture;
    this.name = name;
    this.canvas.setAttribute(
      "aria-label",
      picture === undefined ? "No picture yet" : `Fluoroscopy picture ${name}`,
    );
    this.redraw();
  }

  say(text: string): void {
    this.waiting.textContent = text;
    this.waiting.hidden = text === "";
  }

  invert(): void {
    this.inverted = !this.inverted;
    this.redraw();
  }

  /** @param truth  of the shown view; none while it is not told, or not wished for */
  showOutlines(truth: QuizViewTruth | undefined): void {
    this.outlines.replaceChildren();
    const picture = this.shown;
    if (truth === undefined || picture === undefined) return;
    this.outlines.setAttribute("viewBox", `0 0 ${picture.width} ${picture.height}`);
    const line = (pixels: readonly number[], kind: string): SVGElement =>
      makeSvg("polygon", { class: kind, points: polygonPoints(pixels) });
    for (const bone of truth.bone) this.outlines.append(line(bone.pixels, "quiz-bone"));
    this.outlines.append(line(truth.screw.pixels, "quiz-screw"));
  }

  private redraw(): void {
    const side = Math.round(this.canvas.clientWidth * Math.min(devicePixelRatio, 2));
    if (side <= 0) return;
    if (this.canvas.width !== side) this.canvas.width = this.canvas.height = side;
    drawPicture(this.canvas, this.shown, this.inverted, { view: this.name });
  }
}

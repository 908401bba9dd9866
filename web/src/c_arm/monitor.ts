// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One screen of the C-arm: a picture at the screen's own resolution, or what to do to get one.
import { make, setText } from "../dom";
import type { CArmPicture } from "../protocol";
import { drawCross, drawPicture, drawRuler, type Overlay } from "./picture_canvas";
import type { PicturePoint, Ruler } from "./ruler_model";

export interface Shown {
  readonly picture: CArmPicture | undefined;
  readonly inverted: boolean;
  readonly overlay: Overlay;
  readonly ruler?: Ruler;
  /** Where the next point goes by keys. */
  readonly cross?: PicturePoint | undefined;
}

export class Monitor {
  readonly element: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  private readonly empty = make("p.c-arm-empty");
  private readonly name: string;
  private shown: Shown | undefined;
  /** Where on the picture one pressed. */
  onPoint: ((point: PicturePoint) => void) | undefined;
  /** A key over the picture, while it takes them. @return whether it was one of its own */
  onKey: ((event: KeyboardEvent) => boolean) | undefined;

  /** @param name  for who does not see it: "Fluoroscopy", "Reference" */
  constructor(name: string, canvasClass: string, ...signs: readonly HTMLElement[]) {
    this.name = name;
    this.canvas = make(`canvas.${canvasClass}` as "canvas", { role: "img" });
    this.element = make("div.c-arm-frame", {}, this.canvas, this.empty, ...signs);
    this.canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || this.shown?.picture === undefined) return;
      const box = this.canvas.getBoundingClientRect();
      this.onPoint?.({
        x: (event.clientX - box.left) / box.width,
        y: (event.clientY - box.top) / box.height,
      });
    });
    this.canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey || this.onKey?.(event) !== true) return;
      event.preventDefault();
      event.stopPropagation();
    });
    new ResizeObserver(() => {
      this.redraw();
    }).observe(this.canvas);
  }

  /** @param text  said while there is no picture */
  sayWhileEmpty(text: string): void {
    setText(this.empty, text);
  }

  /** @param says  what its keys do; none: it takes none */
  takeKeys(says: string | undefined): void {
    if (says === undefined) {
      this.canvas.removeAttribute("tabindex");
      this.canvas.removeAttribute("aria-description");
      this.canvas.setAttribute("role", "img");
      return;
    }
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-description", says);
    this.canvas.focus({ preventScroll: true });
  }

  show(shown: Shown): void {
    this.shown = shown;
    this.redraw();
  }

  private redraw(): void {
    if (this.shown === undefined) return;
    const { cross, inverted, overlay, picture, ruler } = this.shown;
    const side = Math.round(this.canvas.clientWidth * Math.min(2, window.devicePixelRatio));
    // Setting the size also clears the canvas.
    if (side > 1) this.canvas.width = this.canvas.height = side;
    drawPicture(this.canvas, picture, inverted, overlay);
    if (picture !== undefined && ruler !== undefined) drawRuler(this.canvas, picture, ruler);
    if (picture !== undefined && cross !== undefined) drawCross(this.canvas, cross);
    this.empty.hidden = picture !== undefined;
    const says = picture === undefined ? `No ${this.name.toLowerCase()} picture yet` : "";
    this.canvas.setAttribute("aria-label", says || `${this.name} picture ${overlay.view}`);
  }
}

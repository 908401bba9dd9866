// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One of the three pictures: slice, crosshair, measures and words at its edges on a canvas, and what
// mouse and fingers do on it.
import { make } from "../dom";
import type { Vec3 } from "../protocol";
import type { CutLine } from "./cut_line_model";
import { drawCut, drawMeasure } from "./measure_drawing";
import type { Measure } from "./measure_model";
import type { Volume } from "./nifti_model";
import { along, dot, type Plane } from "./planes_model";
import {
  drawGrey,
  drawLabels,
  pixelOf,
  placeAt,
  type GreyWindow,
  type Overlay,
  type SliceView,
} from "./slice_model";

/** What all pictures show alike. */
export interface Shown {
  readonly ct: Volume;
  readonly labels: Volume | undefined;
  readonly grey: GreyWindow;
  readonly overlay: Overlay;
  readonly cross: Vec3;
  readonly crossShown: boolean;
  readonly measures: readonly Measure[];
  readonly mmPerPixel: number;
  readonly brush: Brush | undefined;
  /** By which a bone is about to be cut. */
  readonly cut: CutLine | undefined;
}

/** Shown as a ring at the pointer. */
export interface Brush {
  readonly radiusMm: number;
  readonly isEraser: boolean;
}

export interface PanelEvents {
  /** Pressed or dragged with the first button or one finger. */
  press(plane: Plane, mm: Vec3, phase: "down" | "move" | "up", event: PointerEvent): void;
  hover(mm: Vec3 | undefined): void;
  scroll(plane: Plane, slices: number): void;
  zoom(factor: number): void;
  window(right: number, down: number): void;
  /** The keys go here from now on. */
  focus(panel: SlicePanel): void;
}

const LINE = "#5cc8ff";
const PLANE_TITLE = { axial: "Axial", coronal: "Coronal", sagittal: "Sagittal" } as const;
/** Finer than a screen shows a CT; keeps a large screen's slices quick. */
const MOST_PIXELS = 700_000;

export class SlicePanel {
  readonly element: HTMLElement;
  readonly canvas = make("canvas", { tabindex: "0", role: "img" });
  /** Where the picture's middle lies off the crosshair, in its plane [mm]. */
  pan: readonly [number, number] = [0, 0];
  private plane: Plane;
  private readonly words = {
    right: make("span.scan-edge.right"),
    left: make("span.scan-edge.left"),
    up: make("span.scan-edge.up"),
    down: make("span.scan-edge.down"),
  };
  private readonly where = make("span.scan-where");
  private readonly grey = document.createElement("canvas");
  private image: ImageData | undefined;
  private shown: Shown | undefined;
  private readonly fingers = new Map<number, readonly [number, number]>();
  private drag: "press" | "pan" | "window" | "fingers" | undefined;
  private last: readonly [number, number] = [0, 0];
  private pointer: readonly [number, number] | undefined;

  constructor(
    plane: Plane,
    private readonly events: PanelEvents,
  ) {
    this.plane = plane;
    this.element = make(
      `section.scan-panel.${plane.id}` as "section",
      { "aria-label": PLANE_TITLE[plane.id] },
      this.canvas,
      make("h2.scan-panel-title", {}, PLANE_TITLE[plane.id]),
      this.where,
      ...Object.values(this.words),
    );
    this.setPlane(plane);
    this.listen();
  }

  setPlane(plane: Plane): void {
    this.plane = plane;
    this.words.right.textContent = plane.words.right;
    this.words.left.textContent = plane.words.left;
    this.words.up.textContent = plane.words.up;
    this.words.down.textContent = plane.words.down;
    this.canvas.setAttribute(
      "aria-label",
      `${PLANE_TITLE[plane.id]} slice, ${plane.words.up.toLowerCase()} is up; arrows move the crosshair, Page up and down scroll`,
    );
    this.pan = [0, 0];
  }

  get planeNow(): Plane {
    return this.plane;
  }

  /** In CSS pixels. */
  private get size(): readonly [number, number] {
    return [Math.max(2, this.canvas.clientWidth), Math.max(2, this.canvas.clientHeight)];
  }

  private view(shown: Shown, pixelsPerCss = 1): SliceView {
    const [right, down] = this.pan;
    const centre = along(along(shown.cross, right, this.plane.right), down, this.plane.down);
    return { plane: this.plane, centre, mmPerPixel: shown.mmPerPixel / pixelsPerCss };
  }

  /** The crosshair went from one place to another: the picture stays, unless it would leave it. */
  keepStill(from: Vec3, to: Vec3, mmPerPixel: number): void {
    const d = along(to, -1, from);
    const pan = [
      this.pan[0] - dot(d, this.plane.right),
      this.pan[1] - dot(d, this.plane.down),
    ] as const;
    const [w, h] = this.size;
    const isIn =
      Math.abs(pan[0]) < 0.45 * w * mmPerPixel && Math.abs(pan[1]) < 0.45 * h * mmPerPixel;
    this.pan = isIn ? pan : [0, 0];
  }

  draw(shown: Shown): void {
    this.shown = shown;
    const [w, h] = this.size;
    const ratio = Math.min(devicePixelRatio, 2, Math.sqrt(MOST_PIXELS / (w * h)));
    const [gw, gh] = [Math.round(w * ratio), Math.round(h * ratio)];
    if (this.grey.width !== gw || this.grey.height !== gh || this.image === undefined) {
      this.grey.width = gw;
      this.grey.height = gh;
      this.image = new ImageData(gw, gh);
    }
    const pixels = new Uint32Array(this.image.data.buffer);
    const fine = this.view(shown, ratio);
    drawGrey(shown.ct, fine, shown.grey, gw, gh, pixels);
    if (shown.labels !== undefined) drawLabels(shown.labels, fine, shown.overlay, gw, gh, pixels);
    this.grey.getContext("2d")?.putImageData(this.image, 0, 0);
    const dots = Math.min(2, devicePixelRatio);
    if (this.canvas.width !== Math.round(w * dots)) this.canvas.width = Math.round(w * dots);
    if (this.canvas.height !== Math.round(h * dots)) this.canvas.height = Math.round(h * dots);
    const context = this.canvas.getContext("2d");
    if (context === null) return;
    context.setTransform(dots, 0, 0, dots, 0, 0);
    context.drawImage(this.grey, 0, 0, w, h);
    this.drawLines(context, shown, w, h);
    const depth = dot(shown.cross, this.plane.away);
    this.where.textContent = `${depth.toFixed(1)} mm`;
  }

  private drawLines(context: CanvasRenderingContext2D, shown: Shown, w: number, h: number): void {
    const view = this.view(shown);
    if (shown.crossShown) {
      const [x, y] = pixelOf(view, w, h, shown.cross);
      context.strokeStyle = LINE;
      context.globalAlpha = 0.7;
      context.lineWidth = 1;
      context.beginPath();
      // Open in the middle, so that what is pointed at is seen.
      for (const [from, to] of [
        [0, x - 9],
        [x + 9, w],
      ] as const) {
        context.moveTo(from, Math.round(y) + 0.5);
        context.lineTo(to, Math.round(y) + 0.5);
      }
      for (const [from, to] of [
        [0, y - 9],
        [y + 9, h],
      ] as const) {
        context.moveTo(Math.round(x) + 0.5, from);
        context.lineTo(Math.round(x) + 0.5, to);
      }
      context.stroke();
      context.globalAlpha = 1;
    }
    const sheet = { context, view, width: w, height: h };
    for (const measure of shown.measures) drawMeasure(sheet, measure);
    if (shown.cut !== undefined) drawCut(sheet, shown.cut);
    if (shown.brush !== undefined) this.drawBrush(context, view, shown, shown.brush, w, h);
    this.drawScale(context, shown, w, h);
  }

  /** At the pointer; without one, at the crosshair, where the keys would paint. */
  private drawBrush(
    context: CanvasRenderingContext2D,
    view: SliceView,
    shown: Shown,
    brush: Brush,
    w: number,
    h: number,
  ): void {
    const [x, y] = this.pointer ?? pixelOf(view, w, h, shown.cross);
    context.strokeStyle = brush.isEraser ? "#ef7d6b" : "#ffffff";
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(x, y, Math.max(2, brush.radiusMm / shown.mmPerPixel), 0, 2 * Math.PI);
    context.stroke();
  }

  /** A bar of 10 mm. */
  private drawScale(context: CanvasRenderingContext2D, shown: Shown, w: number, h: number): void {
    const length = 10 / shown.mmPerPixel;
    if (length > w / 2) return;
    const x = w - 14 - length;
    const y = h - 14;
    context.strokeStyle = "#e8eef0";
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x, y - 4);
    context.lineTo(x, y);
    context.lineTo(x + length, y);
    context.lineTo(x + length, y - 4);
    context.stroke();
    context.font = "12px 'Inter Variable', sans-serif";
    context.fillStyle = "#e8eef0";
    context.fillText("10 mm", x, y - 8);
  }

  private place(event: PointerEvent | WheelEvent): Vec3 | undefined {
    if (this.shown === undefined) return undefined;
    const box = this.canvas.getBoundingClientRect();
    const [w, h] = this.size;
    return placeAt(this.view(this.shown), w, h, event.clientX - box.left, event.clientY - box.top);
  }

  private listen(): void {
    const { canvas } = this;
    canvas.addEventListener("focus", () => {
      this.events.focus(this);
    });
    canvas.addEventListener("contextmenu", (event) => {
      event.preventDefault();
    });
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        if (event.ctrlKey || event.metaKey) this.events.zoom(event.deltaY < 0 ? 1.12 : 1 / 1.12);
        else this.events.scroll(this.plane, Math.sign(event.deltaY));
      },
      { passive: false },
    );
    canvas.addEventListener("pointerdown", (event) => {
      this.begin(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      this.move(event);
    });
    for (const end of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(end, (event) => {
        this.end(event);
      });
    }
    canvas.addEventListener("pointerleave", () => {
      this.pointer = undefined;
      this.events.hover(undefined);
    });
  }

  private begin(event: PointerEvent): void {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
    this.last = [event.clientX, event.clientY];
    if (this.fingers.size > 1) {
      this.drag = "fingers";
      return;
    }
    if (event.button === 1 || (event.button === 0 && event.altKey)) this.drag = "pan";
    else if (event.button === 2) this.drag = "window";
    else this.drag = "press";
    const mm = this.place(event);
    if (this.drag === "press" && mm !== undefined) this.events.press(this.plane, mm, "down", event);
  }

  private move(event: PointerEvent): void {
    const mm = this.place(event);
    const box = this.canvas.getBoundingClientRect();
    this.pointer = [event.clientX - box.left, event.clientY - box.top];
    this.events.hover(mm);
    if (this.shown?.brush !== undefined && this.drag === undefined) this.draw(this.shown);
    if (this.drag === undefined || mm === undefined || this.shown === undefined) return;
    const [dx, dy] = [event.clientX - this.last[0], event.clientY - this.last[1]];
    if (this.drag === "fingers") return this.twoFingers(event);
    this.last = [event.clientX, event.clientY];
    if (this.drag === "press") this.events.press(this.plane, mm, "move", event);
    else if (this.drag === "window") this.events.window(dx, dy);
    else this.shift(dx, dy);
  }

  /** By pixels on the screen. */
  shift(dx: number, dy: number): void {
    if (this.shown === undefined) return;
    const mm = this.shown.mmPerPixel;
    this.pan = [this.pan[0] - dx * mm, this.pan[1] - dy * mm];
    this.draw(this.shown);
  }

  private twoFingers(event: PointerEvent): void {
    const before = [...this.fingers.values()];
    this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
    const now = [...this.fingers.values()];
    const [a, b] = before;
    const [c, d] = now;
    if (a === undefined || b === undefined || c === undefined || d === undefined) return;
    const apart = Math.hypot(a[0] - b[0], a[1] - b[1]);
    if (apart > 0) this.events.zoom(Math.hypot(c[0] - d[0], c[1] - d[1]) / apart);
    this.shift((c[0] + d[0] - a[0] - b[0]) / 2, (c[1] + d[1] - a[1] - b[1]) / 2);
  }

  private end(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    const mm = this.place(event);
    if (this.drag === "press" && mm !== undefined) this.events.press(this.plane, mm, "up", event);
    if (this.drag !== "fingers" || this.fingers.size === 0) this.drag = undefined;
  }
}

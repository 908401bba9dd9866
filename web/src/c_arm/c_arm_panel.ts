// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The C-arm's side of the screen: last picture, views, free angles, dose, the last pictures.
import { button, make, setText } from "../dom";
import type { CArmPicture, CArmStand, NamedView } from "../protocol";
import "./c_arm.css";
import { drawPicture } from "./picture_canvas";
import { Pedal, type PedalHandlers } from "./pedal";
import { narrowViewName, signed, viewName, wrapped } from "./view_name_model";

export interface CArmHandlers extends PedalHandlers {
  takeShot(rotationDeg: number, tiltDeg: number): void;
  /** The C-arm was moved there, without a picture. */
  stand(rotationDeg: number, tiltDeg: number): void;
}

const HISTORY = 6;
const MAX_TILT_DEG = 60;
/** What a mini C-arm shows for a wrist; the host's spectrum is one of about 40 keV. */
const KV_TEXT = "60 kV";
/** What the host says of the C-arm counts again so long after it was moved here. */
const OWN_WORD_MS = 300;

export class CArmPanel {
  readonly element: HTMLElement;
  private readonly canvas = make("canvas.c-arm-picture", { role: "img" });
  private readonly empty = make("p.c-arm-empty");
  private readonly name = make("span.secondary");
  private readonly count = make("p.c-arm-count");
  private readonly stand = make("span.c-arm-stand");
  private readonly strip = make("div.c-arm-strip", {
    role: "group",
    "aria-label": "Last pictures",
  });
  private readonly pictures: CArmPicture[] = [];
  private readonly viewGroup = make("div.c-arm-views", {
    role: "group",
    "aria-label": "Take a picture",
  });
  private views: readonly NamedView[] = [];
  private viewButtons: HTMLButtonElement[] = [];
  private readonly invertButton: HTMLButtonElement;
  private shown = -1;
  private inverted = false;
  private rotationDeg = 0;
  private tiltDeg = 0;
  private movedAtMs = -Infinity;
  /** Newest of the live look that goes on. */
  private live: CArmPicture | undefined;
  private readonly liveSign = make("span.c-arm-live", { role: "status" });
  readonly pedal: Pedal;

  constructor(private readonly handlers: CArmHandlers) {
    this.pedal = new Pedal(handlers);
    this.invertButton = button("Invert", "I", () => {
      this.invert();
    });
    this.invertButton.setAttribute("aria-pressed", "false");
    setText(this.empty, "No picture yet.");
    this.element = make(
      "section.c-arm",
      { "aria-label": "C-arm" },
      make("header.panel-title", {}, make("h2", {}, "C-arm"), this.name),
      make("div.c-arm-frame", {}, this.canvas, this.empty, this.liveSign),
      this.viewGroup,
      this.standRow(),
      this.count,
      this.strip,
    );
    this.showStand();
    this.showCount(0, 0);
    new ResizeObserver(() => {
      this.redraw();
    }).observe(this.canvas);
  }

  private standRow(): HTMLElement {
    const turn = (
      label: string,
      says: string,
      rotation: number,
      tilt: number,
    ): HTMLButtonElement => {
      const b = button(label, "", () => {
        this.turn(rotation, tilt);
      });
      b.setAttribute("aria-label", says);
      b.title = says;
      return b;
    };
    return make(
      "div.c-arm-turn",
      {},
      this.stand,
      turn("↶", "Turn the C-arm by −5° (comma)", -5, 0),
      turn("↷", "Turn the C-arm by +5° (full stop)", 5, 0),
      turn("↓", "Tilt the C-arm towards distal by 5° (Shift + comma)", 0, -5),
      turn("↑", "Tilt the C-arm towards proximal by 5° (Shift + full stop)", 0, 5),
      button("Shoot", "X", () => {
        this.shootFree();
      }),
      this.pedal.button,
      this.invertButton,
    );
  }

  /** The views that have a button and a digit. */
  setViews(views: readonly NamedView[]): void {
    this.views = views;
    this.viewButtons = views.map((view, index) =>
      button(view.label, index < 6 ? String(index + 1) : "", () => {
        this.shoot(index);
      }),
    );
    this.viewGroup.replaceChildren(...this.viewButtons);
    const first = views[0];
    setText(
      this.empty,
      first === undefined ? "No picture yet." : `No picture yet. Press 1 for ${first.label}.`,
    );
    this.rotationDeg = first?.rotation_deg ?? 0;
    this.tiltDeg = first?.tilt_deg ?? 0;
    this.showStand();
    this.redraw();
    this.redrawStrip();
  }

  /** Takes the picture of a named view; the C-arm then stands there. */
  shoot(index: number): void {
    const view = this.views[index];
    if (view === undefined) return;
    this.rotationDeg = view.rotation_deg;
    this.tiltDeg = view.tilt_deg;
    this.shootFree();
  }

  shootFree(): void {
    this.movedAtMs = performance.now();
    this.showStand();
    this.handlers.takeShot(this.rotationDeg, this.tiltDeg);
  }

  turn(rotationDeg: number, tiltDeg: number): void {
    this.rotationDeg = wrapped(this.rotationDeg + rotationDeg);
    this.tiltDeg = Math.min(MAX_TILT_DEG, Math.max(-MAX_TILT_DEG, this.tiltDeg + tiltDeg));
    this.movedAtMs = performance.now();
    this.showStand();
    this.handlers.stand(this.rotationDeg, this.tiltDeg);
  }

  invert(): void {
    this.inverted = !this.inverted;
    this.invertButton.setAttribute("aria-pressed", String(this.inverted));
    this.redraw();
    this.redrawStrip();
  }

  /** Where it stands over the forearm: that turns under it, too. */
  takeStand(stand: CArmStand): void {
    this.showLive(stand.live);
    if (performance.now() - this.movedAtMs < OWN_WORD_MS) return;
    const rotationDeg = Math.round(stand.rotation_deg);
    const tiltDeg = Math.round(stand.tilt_deg);
    if (rotationDeg === this.rotationDeg && tiltDeg === this.tiltDeg) return;
    this.rotationDeg = rotationDeg;
    this.tiltDeg = tiltDeg;
    this.showStand();
  }

  /** After a lost connection the last pictures come again: each takes its own place. */
  add(picture: CArmPicture): void {
    if (picture.kind === "live") {
      this.live = picture;
      this.redraw();
      return;
    }
    this.live = undefined;
    const known = this.pictures.findIndex((one) => one.shot === picture.shot);
    if (known >= 0) {
      this.pictures[known] = picture;
      this.redraw();
      this.redrawStrip();
      return;
    }
    this.pictures.push(picture);
    if (this.pictures.length > HISTORY) this.pictures.shift();
    this.shown = this.pictures.length - 1;
    this.redraw();
    this.redrawStrip();
  }

  clear(): void {
    this.pictures.length = 0;
    this.live = undefined;
    this.shown = -1;
    this.redraw();
    this.redrawStrip();
  }

  showCount(shots: number, doseCgyCm2: number): void {
    const pictures = shots === 1 ? "1 shot" : `${shots} shots`;
    setText(this.count, `${pictures} · ${doseCgyCm2.toFixed(1)} cGy cm²`);
  }

  private showStand(): void {
    setText(this.stand, `${signed(this.rotationDeg)} rot · ${signed(this.tiltDeg)} tilt`);
    this.viewButtons.forEach((b, index) => {
      const view = this.views[index];
      const here =
        view !== undefined && view.label === viewName(this.views, this.rotationDeg, this.tiltDeg);
      b.setAttribute("aria-pressed", String(here));
    });
  }

  private showLive(on: boolean): void {
    setText(this.liveSign, on ? "Live" : "");
    this.liveSign.hidden = !on;
  }

  private nameOf(picture: CArmPicture): string {
    return viewName(this.views, picture.rotationDeg, picture.tiltDeg);
  }

  private redraw(): void {
    const picture = this.live ?? this.pictures[this.shown];
    const side = Math.round(this.canvas.clientWidth * Math.min(2, window.devicePixelRatio));
    // Setting the size also clears the canvas.
    if (side > 1) this.canvas.width = this.canvas.height = side;
    const view = picture === undefined ? "" : this.nameOf(picture);
    drawPicture(this.canvas, picture, this.inverted, { view, kv: KV_TEXT });
    this.empty.hidden = picture !== undefined;
    setText(this.name, picture === undefined ? "" : `${view}, ${this.whenTaken(picture)}`);
    const says =
      picture === undefined ? "No fluoroscopy picture yet" : `Fluoroscopy picture ${view}`;
    this.canvas.setAttribute("aria-label", says);
  }

  private whenTaken(picture: CArmPicture): string {
    if (picture.kind === "live") return "live";
    const old = this.shown < this.pictures.length - 1 ? ", earlier" : "";
    return picture.kind === "held" ? `held, ${picture.shot}${old}` : `shot ${picture.shot}${old}`;
  }

  private redrawStrip(): void {
    this.strip.replaceChildren(
      ...this.pictures.map((picture, index) => {
        const small = make("canvas", { width: "128", height: "128", "aria-hidden": "true" });
        drawPicture(small, picture, this.inverted, undefined);
        const b = make(
          "button.quiet",
          { type: "button", "aria-label": `Show shot ${picture.shot}, ${this.nameOf(picture)}` },
          small,
          make("span", {}, narrowViewName(this.views, picture.rotationDeg, picture.tiltDeg)),
        );
        b.setAttribute("aria-pressed", String(index === this.shown));
        b.addEventListener("click", () => {
          this.shown = index;
          this.redraw();
          this.redrawStrip();
        });
        return b;
      }),
    );
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The C-arm's side of the screen: the live monitor and, of a picture that was kept, a second one; the
// stand, what is done with pictures, dose, the last pictures; enlarged, it takes the theatre's place.
import { button, make, setText } from "../dom";
import { withKeys } from "../key_caps";
import type { CArmPicture, CArmStand, NamedView, WristPose } from "../protocol";
import "./c_arm.css";
import { DoseByView, dosesText } from "./dose_by_view_model";
import { Monitor } from "./monitor";
import type { Pedal } from "./pedal";
import { drawPicture } from "./picture_canvas";
import { PictureRuler } from "./picture_ruler";
import { savePicture } from "./save_picture";
import { Stand, type StandHandlers } from "./stand";
import { narrowViewName, viewName } from "./view_name_model";

export interface CArmHandlers extends StandHandlers {
  /** The pictures and the theatre change places. */
  enlarge(on: boolean): void;
  /** The beam is to be drawn in the theatre, or not, while the C-arm rests. */
  beam(on: boolean): void;
}

const HISTORY = 6;

function toggle(
  label: string,
  keys: string,
  title: string,
  onClick: () => void,
): HTMLButtonElement {
  const b = button(label, keys, onClick);
  b.setAttribute("aria-pressed", "false");
  b.title = withKeys(`${title} (${keys})`);
  return b;
}

export class CArmPanel {
  readonly element: HTMLElement;
  private readonly stand: Stand;
  private readonly name = make("span.secondary");
  private readonly count = make("p.c-arm-count");
  private readonly strip = make("div.c-arm-strip", {
    role: "group",
    "aria-label": "Last pictures",
  });
  private readonly pictures: CArmPicture[] = [];
  private shown = -1;
  private inverted = false;
  /** Newest of the live look that goes on. */
  private live: CArmPicture | undefined;
  private kept: CArmPicture | undefined;
  private readonly doses = new DoseByView();
  private readonly doseList = make("p.c-arm-doses.secondary");
  private isEnlarged = false;
  private beamIsShown = false;
  private readonly liveSign = make("span.c-arm-live", { role: "status" });
  private readonly monitor = new Monitor("Fluoroscopy", "c-arm-picture", this.liveSign);
  private readonly ruler: PictureRuler;
  private readonly reference = new Monitor("Reference", "c-arm-reference-picture");
  private readonly referenceName = make("span.secondary");
  private readonly referenceBox: HTMLElement;
  private readonly invertButton: HTMLButtonElement;
  private readonly enlargeButton: HTMLButtonElement;
  private readonly rulerButton: HTMLButtonElement;
  private readonly beamButton: HTMLButtonElement;

  /** @param patient  written on a picture that is saved */
  constructor(
    private readonly patient: string,
    private readonly handlers: CArmHandlers,
  ) {
    this.stand = new Stand(handlers);
    this.ruler = new PictureRuler(
      this.monitor,
      () => this.picture,
      () => {
        this.redraw();
      },
    );
    this.invertButton = toggle("Invert", "{KeyI}", "White bone on black", () => {
      this.invert();
    });
    this.enlargeButton = toggle(
      "Enlarge",
      "7",
      "The pictures and the theatre change places",
      () => {
        this.enlarge(!this.isEnlarged);
      },
    );
    this.rulerButton = toggle(
      "Ruler",
      "{Quote}",
      "Two points of the picture, by clicks or by arrows and Enter: millimetres at the isocentre",
      () => {
        this.toggleRuler();
      },
    );
    this.beamButton = toggle(
      "Beam",
      "{Semicolon}",
      "Draws the beam in the theatre, also while the C-arm rests",
      () => {
        this.toggleBeam();
      },
    );
    this.referenceBox = make(
      "section.c-arm-reference",
      { "aria-label": "Reference" },
      make("header.panel-title", {}, make("h3", {}, "Reference"), this.referenceName),
      this.reference.element,
    );
    this.referenceBox.hidden = true;
    this.monitor.sayWhileEmpty("No picture yet.");
    this.element = make(
      "section.c-arm",
      { "aria-label": "C-arm" },
      make("header.panel-title", {}, make("h2", {}, "C-arm"), this.name),
      this.monitor.element,
      this.stand.viewGroup,
      this.stand.row,
      this.pictureRow(),
      this.ruler.reading,
      this.count,
      this.doseList,
      make("div.c-arm-earlier", {}, this.referenceBox, this.strip),
    );
    this.showLive(false);
    this.showCount(0, 0);
    this.redraw();
  }

  /** What is done with the picture that is shown. */
  private pictureRow(): HTMLElement {
    const save = button("Save", "{Backslash}", () => {
      this.save();
    });
    save.title = withKeys("As a PNG file with its text ({Backslash})");
    const keep = button("Keep as reference", "8", () => {
      this.keepAsReference();
    });
    keep.title = withKeys("Puts the picture onto the second monitor (8)");
    return make(
      "div.c-arm-turn.c-arm-uses",
      { role: "group", "aria-label": "Picture" },
      this.enlargeButton,
      keep,
      this.invertButton,
      this.rulerButton,
      this.beamButton,
      save,
    );
  }

  get pedal(): Pedal {
    return this.stand.pedal;
  }

  nextVoltage(): void {
    this.stand.nextVoltage();
  }

  nextDose(): void {
    this.stand.nextDose();
  }

  /** The views that have a button and a digit. */
  setViews(views: readonly NamedView[]): void {
    this.stand.setViews(views);
    const [first] = views;
    this.monitor.sayWhileEmpty(
      first === undefined ? "No picture yet." : `No picture yet. Press 1 for ${first.label}.`,
    );
    this.redraw();
    this.redrawStrip();
  }

  shoot(index: number): void {
    this.stand.shoot(index);
  }

  shootNext(): void {
    this.stand.shootNext();
  }

  shootFree(): void {
    this.stand.shootFree();
  }

  turn(rotationDeg: number, tiltDeg: number): void {
    this.stand.turn(rotationDeg, tiltDeg);
  }

  takeWrist(now: WristPose): void {
    this.stand.takeWrist(now);
  }

  takeStand(stand: CArmStand): void {
    this.showLive(stand.live);
    this.stand.takeStand(stand);
  }

  invert(): void {
    this.inverted = !this.inverted;
    this.invertButton.setAttribute("aria-pressed", String(this.inverted));
    this.redraw();
    this.redrawStrip();
  }

  enlarge(on: boolean): void {
    if (this.isEnlarged === on) return;
    this.isEnlarged = on;
    this.enlargeButton.setAttribute("aria-pressed", String(on));
    this.element.classList.toggle("enlarged", on);
    this.handlers.enlarge(on);
  }

  get enlarged(): boolean {
    return this.isEnlarged;
  }

  /** The picture that is shown stays on the second monitor, whatever comes. */
  keepAsReference(): void {
    if (this.picture === undefined) {
      this.handlers.say("There is no picture to keep yet.");
      return;
    }
    this.kept = this.picture;
    this.redraw();
  }

  save(): void {
    const { picture } = this;
    if (picture === undefined) {
      this.handlers.say("There is no picture to save yet.");
      return;
    }
    const overlay = { view: this.nameOf(picture) };
    savePicture(picture, this.inverted, overlay, this.ruler.drawn.ruler, this.patient);
    this.handlers.say("The picture is saved among the downloads.");
  }

  toggleRuler(): void {
    const says = this.ruler.toggle();
    this.rulerButton.setAttribute("aria-pressed", String(this.ruler.on));
    this.element.classList.toggle("ruling", this.ruler.on);
    if (says !== undefined) this.handlers.say(says);
  }

  toggleBeam(): void {
    this.beamIsShown = !this.beamIsShown;
    this.beamButton.setAttribute("aria-pressed", String(this.beamIsShown));
    this.handlers.beam(this.beamIsShown);
  }

  /** The one that is shown. */
  private get picture(): CArmPicture | undefined {
    return this.live ?? this.pictures[this.shown];
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
    } else {
      this.pictures.push(picture);
      if (this.pictures.length > HISTORY) this.pictures.shift();
      this.shown = this.pictures.length - 1;
      this.ruler.forget();
    }
    this.redraw();
    this.redrawStrip();
  }

  clear(): void {
    this.pictures.length = 0;
    this.live = this.kept = undefined;
    this.shown = -1;
    this.doses.clear();
    setText(this.doseList, "");
    this.redraw();
    this.redrawStrip();
  }

  showCount(shots: number, doseCgyCm2: number): void {
    const pictures = shots === 1 ? "1 shot" : `${shots} shots`;
    setText(this.count, `${pictures} · ${doseCgyCm2.toFixed(1)} cGy cm²`);
    const before = this.doses.list.length;
    this.doses.see(doseCgyCm2, this.stand.viewName);
    if (this.doses.list.length > 0 || before > 0)
      setText(this.doseList, `By view: ${dosesText(this.doses.list)}`);
  }

  private showLive(on: boolean): void {
    setText(this.liveSign, on ? "Live" : "");
    this.liveSign.hidden = !on;
  }

  private nameOf(picture: CArmPicture): string {
    return viewName(this.stand.views, picture.rotationDeg, picture.tiltDeg);
  }

  private redraw(): void {
    const { inverted, kept, picture } = this;
    const view = picture === undefined ? "" : this.nameOf(picture);
    this.monitor.show({ picture, inverted, overlay: { view }, ...this.ruler.drawn });
    this.ruler.showReading();
    setText(this.name, picture === undefined ? "" : `${view}, ${this.whenTaken(picture)}`);
    this.referenceBox.hidden = kept === undefined;
    if (kept === undefined) return;
    const keptView = this.nameOf(kept);
    setText(this.referenceName, kept.shot > 0 ? `${keptView}, shot ${kept.shot}` : keptView);
    const overlay = { view: keptView };
    this.reference.show({ picture: kept, inverted, overlay });
  }

  private whenTaken(picture: CArmPicture): string {
    if (picture.kind === "live") return "live";
    const old = this.shown < this.pictures.length - 1 ? ", earlier" : "";
    return picture.kind === "held" ? `held, ${picture.shot}${old}` : `shot ${picture.shot}${old}`;
  }

  private redrawStrip(): void {
    const { views } = this.stand;
    this.strip.replaceChildren(
      ...this.pictures.map((picture, index) => {
        const small = make("canvas", { width: "128", height: "128", "aria-hidden": "true" });
        drawPicture(small, picture, this.inverted, undefined);
        const b = make(
          "button.quiet",
          { type: "button", "aria-label": `Show shot ${picture.shot}, ${this.nameOf(picture)}` },
          small,
          make("span", {}, narrowViewName(views, picture.rotationDeg, picture.tiltDeg)),
        );
        b.setAttribute("aria-pressed", String(index === this.shown));
        b.addEventListener("click", () => {
          this.shown = index;
          this.ruler.forget();
          this.redraw();
          this.redrawStrip();
        });
        return b;
      }),
    );
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The C-arm's side of the screen: the live monitor and, of a picture that was kept, a second one; views,
// free angles, dose, the last pictures; enlarged, it takes the theatre's place.
import { button, make, setText } from "../dom";
import { withKeys } from "../key_caps";
import type { CArmPicture, CArmStand, DoseLevel, NamedView, WristPose } from "../protocol";
import "./c_arm.css";
import { Monitor } from "./monitor";
import { DoseByView, dosesText } from "./dose_by_view_model";
import { drawPicture } from "./picture_canvas";
import { Pedal, type PedalHandlers } from "./pedal";
import {
  keyStep,
  nudgedPoint,
  rulerMm,
  rulerText,
  withPoint,
  type PicturePoint,
  type Ruler,
} from "./ruler_model";
import { savePicture } from "./save_picture";
import { narrowViewName, signed, viewName, wrapped } from "./view_name_model";

export interface CArmHandlers extends PedalHandlers {
  takeShot(rotationDeg: number, tiltDeg: number): void;
  /** The C-arm was moved there, without a picture. */
  stand(rotationDeg: number, tiltDeg: number): void;
  /** The tube is set so from now on. */
  tube(kv: number, level: DoseLevel): void;
  /** The hand is to be held so for a view. */
  holdWrist(wish: Partial<WristPose>): void;
  /** The pictures and the theatre change places. */
  enlarge(on: boolean): void;
  /** The beam is to be drawn in the theatre, or not, while the C-arm rests. */
  beam(on: boolean): void;
}

const HISTORY = 6;
const RULER_KEYS = "move the cross by arrows (with Shift far) and set a point by Enter.";
const MAX_TILT_DEG = 60;
/** What the host's tube can be set to (src/procedure/tube_setting.hpp). */
const TUBE_KV = [50, 60, 70] as const;
const DOSE_LEVELS: readonly DoseLevel[] = ["low", "usual", "high"];
/** The hand has come to how a view wants it [deg]; or has not moved for so long. */
const HELD_WITHIN_DEG = 1.5;
const HELD_PATIENCE_MS = 1500;
/** What the host says of the C-arm counts again so long after it was moved here. */
const OWN_WORD_MS = 300;

function kvText({ tubeKv }: CArmPicture): string {
  return `${Math.round(tubeKv)} kV`;
}

function next<T>(all: readonly T[], now: T): T {
  return all[(all.indexOf(now) + 1) % all.length] ?? now;
}

export class CArmPanel {
  readonly element: HTMLElement;
  private readonly name = make("span.secondary");
  private readonly count = make("p.c-arm-count");
  private readonly ruled = make("p.c-arm-ruled", { role: "status" });
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
  private tubeKv: number = 60;
  private doseLevel: DoseLevel = "usual";
  private readonly voltageButton: HTMLButtonElement;
  private readonly doseButton: HTMLButtonElement;
  /** A view that waits until the hand is held for it. */
  private waiting:
    { readonly view: NamedView; movedAtMs: number; pose: WristPose | undefined } | undefined;
  private readonly invertButton: HTMLButtonElement;
  private shown = -1;
  private inverted = false;
  private rotationDeg = 0;
  private tiltDeg = 0;
  private movedAtMs = -Infinity;
  /** Newest of the live look that goes on. */
  private live: CArmPicture | undefined;
  private kept: CArmPicture | undefined;
  private ruler: Ruler = [];
  /** Where the ruler's cross is, once keys have moved it. */
  private cross: PicturePoint | undefined;
  private readonly doses = new DoseByView();
  private readonly doseList = make("p.c-arm-doses.secondary");
  private rules = false;
  private isEnlarged = false;
  private beamIsShown = false;
  private readonly liveSign = make("span.c-arm-live", { role: "status" });
  private readonly monitor = new Monitor("Fluoroscopy", "c-arm-picture", this.liveSign);
  private readonly reference = new Monitor("Reference", "c-arm-reference-picture");
  private readonly referenceName = make("span.secondary");
  private readonly referenceBox: HTMLElement;
  private readonly enlargeButton: HTMLButtonElement;
  private readonly rulerButton: HTMLButtonElement;
  private readonly beamButton: HTMLButtonElement;
  readonly pedal: Pedal;

  /** @param patient  written on a picture that is saved */
  constructor(
    private readonly patient: string,
    private readonly handlers: CArmHandlers,
  ) {
    this.pedal = new Pedal(handlers);
    const toggle = (label: string, keys: string, onClick: () => void): HTMLButtonElement => {
      const b = button(label, keys, onClick);
      b.setAttribute("aria-pressed", "false");
      return b;
    };
    this.invertButton = toggle("Invert", "{KeyI}", () => {
      this.invert();
    });
    this.enlargeButton = toggle("Enlarge", "7", () => {
      this.enlarge(!this.isEnlarged);
    });
    this.enlargeButton.title = "The pictures and the theatre change places";
    this.rulerButton = toggle("Ruler", "{Quote}", () => {
      this.toggleRuler();
    });
    this.rulerButton.title =
      "Two points of the picture, by clicks or by arrows and Enter: millimetres at the isocentre";
    this.beamButton = toggle("Beam", "{Semicolon}", () => {
      this.toggleBeam();
    });
    this.beamButton.title = "Draws the beam in the theatre, also while the C-arm rests";
    this.voltageButton = button("60 kV", "F9", () => {
      this.nextVoltage();
    });
    this.voltageButton.title =
      "Voltage of the tube: lower shows bone against soft tissue, higher costs more";
    this.doseButton = button("Dose: usual", "F10", () => {
      this.nextDose();
    });
    this.doseButton.title = "Of each picture: low is grainy, high costs double";
    this.referenceBox = make(
      "section.c-arm-reference",
      { "aria-label": "Reference" },
      make("header.panel-title", {}, make("h3", {}, "Reference"), this.referenceName),
      this.reference.element,
    );
    this.referenceBox.hidden = true;
    this.monitor.sayWhileEmpty("No picture yet.");
    this.monitor.onPoint = (point) => {
      if (!this.rules) return;
      this.cross = undefined;
      this.setPoint(point);
    };
    this.monitor.onKey = (event) => this.rules && this.ruleByKey(event);
    this.element = make(
      "section.c-arm",
      { "aria-label": "C-arm" },
      make("header.panel-title", {}, make("h2", {}, "C-arm"), this.name),
      this.monitor.element,
      this.viewGroup,
      this.standRow(),
      this.pictureRow(),
      this.ruled,
      this.count,
      this.doseList,
      make("div.c-arm-earlier", {}, this.referenceBox, this.strip),
    );
    this.showStand();
    this.showCount(0, 0);
    this.redraw();
  }

  /** What is done with the picture that is shown. */
  private pictureRow(): HTMLElement {
    const save = button("Save", "{Backslash}", () => {
      this.save();
    });
    save.title = "As a PNG file with its text";
    const keep = button("Keep as reference", "8", () => {
      this.keepAsReference();
    });
    keep.title = "Puts the picture onto the second monitor";
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
      b.setAttribute("aria-label", withKeys(says));
      b.title = withKeys(says);
      return b;
    };
    return make(
      "div.c-arm-turn",
      {},
      this.stand,
      turn("↶", "Turn the C-arm by −5° ({Comma})", -5, 0),
      turn("↷", "Turn the C-arm by +5° ({Period})", 5, 0),
      turn("↓", "Tilt the C-arm towards distal by 5° (Shift + {Comma})", 0, -5),
      turn("↑", "Tilt the C-arm towards proximal by 5° (Shift + {Period})", 0, 5),
      button("Shoot", "{KeyX}", () => {
        this.shootFree();
      }),
      this.pedal.button,
      this.voltageButton,
      this.doseButton,
    );
  }

  nextVoltage(): void {
    const now = TUBE_KV.find((kv) => kv === this.tubeKv) ?? TUBE_KV[1];
    this.handlers.tube(next(TUBE_KV, now), this.doseLevel);
  }

  nextDose(): void {
    this.handlers.tube(this.tubeKv, next(DOSE_LEVELS, this.doseLevel));
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
    this.monitor.sayWhileEmpty(
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
    const { flexion_deg, radial_deviation_deg } = view;
    if (flexion_deg === null && radial_deviation_deg === null) {
      this.waiting = undefined;
      this.shootFree();
      return;
    }
    this.waiting = { view, movedAtMs: performance.now(), pose: undefined };
    this.handlers.holdWrist({
      ...(flexion_deg === null ? {} : { flexion_deg }),
      ...(radial_deviation_deg === null ? {} : { radial_deviation_deg }),
    });
    this.turn(0, 0);
  }

  /** How the hand is held now: a view that waits for it is taken, or given up where it does not go. */
  takeWrist(now: WristPose): void {
    const { waiting } = this;
    if (waiting === undefined) return;
    const { flexion_deg, label, radial_deviation_deg } = waiting.view;
    const away = Math.max(
      flexion_deg === null ? 0 : Math.abs(flexion_deg - now.flexion_deg),
      radial_deviation_deg === null ? 0 : Math.abs(radial_deviation_deg - now.radial_deviation_deg),
    );
    if (away < HELD_WITHIN_DEG) {
      this.waiting = undefined;
      this.shootFree();
      return;
    }
    const { pose } = waiting;
    const isSame =
      pose !== undefined &&
      Math.abs(pose.flexion_deg - now.flexion_deg) +
        Math.abs(pose.radial_deviation_deg - now.radial_deviation_deg) <
        0.1;
    if (!isSame) {
      waiting.pose = now;
      waiting.movedAtMs = performance.now();
    } else if (performance.now() - waiting.movedAtMs > HELD_PATIENCE_MS) {
      this.waiting = undefined;
      this.handlers.say(
        `The hand does not go as ${label} needs it: its limit, or an instrument, holds it.`,
      );
    }
  }

  /** The named view after the one where the C-arm stands; the first where it stands in none. */
  shootNext(): void {
    const here = this.views.findIndex(
      (view) => view.rotation_deg === this.rotationDeg && view.tilt_deg === this.tiltDeg,
    );
    if (this.views.length > 0) this.shoot((here + 1) % this.views.length);
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
    const overlay = { view: this.nameOf(picture), kv: kvText(picture) };
    savePicture(picture, this.inverted, overlay, this.ruler, this.patient);
    this.handlers.say("The picture is saved among the downloads.");
  }

  toggleRuler(): void {
    this.rules = !this.rules;
    this.ruler = [];
    this.cross = undefined;
    this.rulerButton.setAttribute("aria-pressed", String(this.rules));
    this.element.classList.toggle("ruling", this.rules);
    this.monitor.takeKeys(this.rules ? RULER_KEYS : undefined);
    if (this.rules) this.handlers.say(`Ruler: click two points of the picture, or ${RULER_KEYS}`);
    this.redraw();
  }

  private setPoint(point: PicturePoint): void {
    this.ruler = withPoint(this.ruler, point);
    this.redraw();
  }

  private ruleByKey({ key, shiftKey }: KeyboardEvent): boolean {
    const { picture } = this;
    if (picture === undefined) return false;
    const cross = this.cross ?? { x: 0.5, y: 0.5 };
    if (key === "Enter") {
      this.setPoint(cross);
      return true;
    }
    const step = keyStep(key, shiftKey);
    if (step === undefined) return false;
    this.cross = nudgedPoint(cross, step.right / picture.width, step.down / picture.height);
    this.redraw();
    return true;
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

  /** Where it stands over the forearm: that turns under it, too. */
  takeStand(stand: CArmStand): void {
    this.showLive(stand.live);
    this.showTube(stand.tube_kv, stand.dose_level);
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
    this.ruler = [];
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
    this.doses.see(doseCgyCm2, viewName(this.views, this.rotationDeg, this.tiltDeg));
    if (this.doses.list.length > 0 || before > 0)
      setText(this.doseList, `By view: ${dosesText(this.doses.list)}`);
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

  private showTube(kv: number, level: DoseLevel): void {
    if (kv === this.tubeKv && level === this.doseLevel) return;
    this.tubeKv = kv;
    this.doseLevel = level;
    const say = (b: HTMLButtonElement, text: string): void => {
      const [label] = b.childNodes;
      if (label instanceof Text) label.data = text;
    };
    say(this.voltageButton, `${Math.round(kv)} kV`);
    say(this.doseButton, `Dose: ${level}`);
  }

  private showLive(on: boolean): void {
    setText(this.liveSign, on ? "Live" : "");
    this.liveSign.hidden = !on;
  }

  private nameOf(picture: CArmPicture): string {
    return viewName(this.views, picture.rotationDeg, picture.tiltDeg);
  }

  private redraw(): void {
    const { inverted, kept, picture, ruler } = this;
    const view = picture === undefined ? "" : this.nameOf(picture);
    const { cross } = this;
    const kv = picture === undefined ? "" : kvText(picture);
    this.monitor.show({ picture, inverted, overlay: { view, kv }, ruler, cross });
    const mm = picture === undefined ? undefined : rulerMm(ruler, picture);
    setText(this.ruled, mm === undefined ? "" : rulerText(mm));
    setText(this.name, picture === undefined ? "" : `${view}, ${this.whenTaken(picture)}`);
    this.referenceBox.hidden = kept === undefined;
    if (kept === undefined) return;
    const keptView = this.nameOf(kept);
    setText(this.referenceName, kept.shot > 0 ? `${keptView}, shot ${kept.shot}` : keptView);
    const overlay = { view: keptView, kv: kvText(kept) };
    this.reference.show({ picture: kept, inverted, overlay });
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
          this.ruler = [];
          this.redraw();
          this.redrawStrip();
        });
        return b;
      }),
    );
  }
}

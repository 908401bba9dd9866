// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the C-arm stands and how its tube is set: named views, free angles, voltage, dose, pedal. What
// the host says of it counts, but for a moment after it was moved here.
import { button, make, setText } from "../dom";
import { withKeys } from "../key_caps";
import type { CArmStand, DoseLevel, NamedView, WristPose } from "../protocol";
import { Pedal, type PedalHandlers } from "./pedal";
import { signed, viewName, wrapped } from "./view_name_model";
import { ViewWait } from "./view_wait";

export interface StandHandlers extends PedalHandlers {
  takeShot(rotationDeg: number, tiltDeg: number): void;
  /** The C-arm was moved there, without a picture. */
  stand(rotationDeg: number, tiltDeg: number): void;
  /** The tube is set so from now on. */
  tube(kv: number, level: DoseLevel): void;
  /** The hand is to be held so for a view. */
  holdWrist(wish: Partial<WristPose>): void;
}

const MAX_TILT_DEG = 60;
/** What the host's tube can be set to (src/procedure/tube_setting.hpp). */
const TUBE_KV = [50, 60, 70] as const;
const DOSE_LEVELS: readonly DoseLevel[] = ["low", "usual", "high"];
/** What the host says of the C-arm counts again so long after it was moved here. */
const OWN_WORD_MS = 300;

function next<T>(all: readonly T[], now: T): T {
  return all[(all.indexOf(now) + 1) % all.length] ?? now;
}

/** Changes a button's words and leaves its key. */
function say(b: HTMLButtonElement, text: string): void {
  const [label] = b.childNodes;
  if (label instanceof Text) label.data = text;
}

export class Stand {
  /** The views that have a button and a digit. */
  readonly viewGroup = make("div.c-arm-views", { role: "group", "aria-label": "Take a picture" });
  readonly row: HTMLElement;
  readonly pedal: Pedal;
  private readonly text = make("span.c-arm-stand");
  private readonly voltageButton: HTMLButtonElement;
  private readonly doseButton: HTMLButtonElement;
  private viewButtons: readonly HTMLButtonElement[] = [];
  private named: readonly NamedView[] = [];
  private waiting: ViewWait | undefined;
  private rotationDeg = 0;
  private tiltDeg = 0;
  private movedAtMs = -Infinity;
  private tubeKv: number = 60;
  private doseLevel: DoseLevel = "usual";

  constructor(private readonly handlers: StandHandlers) {
    this.pedal = new Pedal(handlers);
    this.voltageButton = button("60 kV", "F9", () => {
      this.nextVoltage();
    });
    this.voltageButton.title = withKeys(
      "Voltage of the tube: lower shows bone against soft tissue, higher costs more (F9)",
    );
    this.doseButton = button("Dose: usual", "F10", () => {
      this.nextDose();
    });
    this.doseButton.title = withKeys("Of each picture: low is grainy, high costs double (F10)");
    this.row = this.makeRow();
    this.showAngles();
  }

  private makeRow(): HTMLElement {
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
    const shoot = (): void => {
      this.shootFree();
    };
    return make(
      "div.c-arm-turn",
      {},
      this.text,
      turn("↶", "Turn the C-arm by −5° ({Comma})", -5, 0),
      turn("↷", "Turn the C-arm by +5° ({Period})", 5, 0),
      turn("↓", "Tilt the C-arm towards distal by 5° (Shift + {Comma})", 0, -5),
      turn("↑", "Tilt the C-arm towards proximal by 5° (Shift + {Period})", 0, 5),
      button("Shoot", "{KeyX}", shoot, ".c-arm-shoot"),
      this.pedal.button,
      this.voltageButton,
      this.doseButton,
    );
  }

  get views(): readonly NamedView[] {
    return this.named;
  }

  setViews(views: readonly NamedView[]): void {
    this.named = views;
    this.viewButtons = views.map((view, index) =>
      button(view.label, index < 6 ? String(index + 1) : "", () => {
        this.shoot(index);
      }),
    );
    this.viewGroup.replaceChildren(...this.viewButtons);
    this.rotationDeg = views[0]?.rotation_deg ?? 0;
    this.tiltDeg = views[0]?.tilt_deg ?? 0;
    this.showAngles();
  }

  /** What it is called where it stands now. */
  get viewName(): string {
    return viewName(this.named, this.rotationDeg, this.tiltDeg);
  }

  nextVoltage(): void {
    const now = TUBE_KV.find((kv) => kv === this.tubeKv) ?? TUBE_KV[1];
    this.handlers.tube(next(TUBE_KV, now), this.doseLevel);
  }

  nextDose(): void {
    this.handlers.tube(this.tubeKv, next(DOSE_LEVELS, this.doseLevel));
  }

  /** Takes the picture of a named view; the C-arm then stands there. */
  shoot(index: number): void {
    const view = this.named[index];
    if (view === undefined) return;
    this.rotationDeg = view.rotation_deg;
    this.tiltDeg = view.tilt_deg;
    if (!ViewWait.isWanted(view)) {
      this.waiting = undefined;
      this.shootFree();
      return;
    }
    const { flexion_deg, radial_deviation_deg } = view;
    this.waiting = new ViewWait(view, performance.now());
    this.handlers.holdWrist({
      ...(flexion_deg === null ? {} : { flexion_deg }),
      ...(radial_deviation_deg === null ? {} : { radial_deviation_deg }),
    });
    this.turn(0, 0);
  }

  /** How the hand is held now: a view that waits for it is taken, or given up where it does not go. */
  takeWrist(now: WristPose): void {
    const { waiting } = this;
    const found = waiting?.see(now, performance.now());
    if (waiting === undefined || found === "waits") return;
    this.waiting = undefined;
    if (found === "held") this.shootFree();
    else
      this.handlers.say(
        `The hand does not go as ${waiting.view.label} needs it: its limit, or an instrument, holds it.`,
      );
  }

  /** The named view after the one where the C-arm stands; the first where it stands in none. */
  shootNext(): void {
    const here = this.named.findIndex(
      (view) => view.rotation_deg === this.rotationDeg && view.tilt_deg === this.tiltDeg,
    );
    if (this.named.length > 0) this.shoot((here + 1) % this.named.length);
  }

  shootFree(): void {
    this.movedAtMs = performance.now();
    this.showAngles();
    this.handlers.takeShot(this.rotationDeg, this.tiltDeg);
  }

  turn(rotationDeg: number, tiltDeg: number): void {
    this.rotationDeg = wrapped(this.rotationDeg + rotationDeg);
    this.tiltDeg = Math.min(MAX_TILT_DEG, Math.max(-MAX_TILT_DEG, this.tiltDeg + tiltDeg));
    this.movedAtMs = performance.now();
    this.showAngles();
    this.handlers.stand(this.rotationDeg, this.tiltDeg);
  }

  /** Where it stands over the forearm: that turns under it, too. */
  takeStand(stand: CArmStand): void {
    this.showTube(stand.tube_kv, stand.dose_level);
    if (performance.now() - this.movedAtMs < OWN_WORD_MS) return;
    const rotationDeg = Math.round(stand.rotation_deg);
    const tiltDeg = Math.round(stand.tilt_deg);
    if (rotationDeg === this.rotationDeg && tiltDeg === this.tiltDeg) return;
    this.rotationDeg = rotationDeg;
    this.tiltDeg = tiltDeg;
    this.showAngles();
  }

  private showAngles(): void {
    setText(this.text, `${signed(this.rotationDeg)} rot · ${signed(this.tiltDeg)} tilt`);
    this.viewButtons.forEach((b, index) => {
      const here = this.named[index]?.label === this.viewName;
      b.setAttribute("aria-pressed", String(here));
    });
  }

  private showTube(kv: number, level: DoseLevel): void {
    if (kv === this.tubeKv && level === this.doseLevel) return;
    this.tubeKv = kv;
    this.doseLevel = level;
    say(this.voltageButton, `${Math.round(kv)} kV`);
    say(this.doseButton, `Dose: ${level}`);
  }
}

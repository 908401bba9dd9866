// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Under the theatre: what a keyboard does with the hand, for mouse and fingers. What the pointer drags,
// nearer and back, push, and the driver for as long as its button is held.
import { button, make, setText, whileHeld } from "../dom";
import { keyCap, nameShortcut } from "../key_caps";
import { MAX_THRUST_N, THRUST_STEP_N, type HeldAction } from "../operation";
import type { Driver } from "../protocol";
import "./drive_controls.css";
import type { DragMode } from "./hand_pointer";

export interface DriveHandlers {
  /** @param holder  by which it is let go */
  hold(holder: string, action: HeldAction): void;
  letGo(holder: string): void;
  push(n: number): void;
  drags(mode: DragMode): void;
  aimAlongSight(): void;
  coarse(): void;
}

const MODES: readonly (readonly [DragMode, string, string])[] = [
  ["tip", "Tip", "Dragging moves the tip over the bone; two fingers turn the view"],
  ["shaft", "Shaft", "Dragging turns the shaft about its tip"],
  ["view", "View", "Dragging turns the view; two fingers shift it"],
];

export class DriveControls {
  readonly element: HTMLElement;
  private readonly modes: readonly HTMLButtonElement[];
  private readonly slider: HTMLInputElement;
  private readonly reading = make("output.push-reading");
  private readonly forward: HTMLButtonElement;
  private readonly reverse: HTMLButtonElement;
  private readonly coarse: HTMLButtonElement;

  constructor(private readonly handlers: DriveHandlers) {
    this.modes = MODES.map(([mode, label, title]) => {
      const b = button(label, "", () => {
        this.showMode(mode);
        handlers.drags(mode);
      });
      b.title = title;
      return b;
    });
    this.slider = make("input", {
      type: "range",
      id: "push",
      min: "0",
      max: String(MAX_THRUST_N),
      step: String(THRUST_STEP_N),
      "aria-label": "Push of the hand in newtons",
    });
    this.slider.addEventListener("input", () => {
      handlers.push(Number(this.slider.value));
    });
    this.coarse = button("Coarse", "{KeyY}", handlers.coarse, ".quiet.coarse");
    this.coarse.title = "Steps of 1 mm and 5° by keys, or fine again";
    const aim = button("Aim", "Enter", handlers.aimAlongSight, ".quiet");
    aim.firstChild?.after(make("span.wide", {}, "as seen"));
    aim.setAttribute("aria-label", "Aim as seen");
    aim.title = "Lays the tip onto the bone in the middle and the shaft along your sight";
    this.forward = this.held("Drive", "Space", { kind: "drive", driver: "forward" });
    this.forward.classList.add("drive");
    this.reverse = this.held("Reverse", "{KeyR}", { kind: "drive", driver: "reverse" });
    this.element = make(
      "div.drive-controls",
      { role: "group", "aria-label": "Hand" },
      make("div.drag-modes", { role: "group", "aria-label": "What dragging moves" }, ...this.modes),
      this.held("Nearer", "{KeyA}", { kind: "approach", closer: true }),
      this.held("Back", "{KeyD}", { kind: "approach", closer: false }),
      aim,
      this.coarse,
      make("span.gap"),
      make("label.push", { for: "push" }, make("span", {}, "Push"), this.slider, this.reading),
      make("div.drive-ways", {}, this.reverse, this.forward),
    );
    this.showMode("tip");
  }

  private held(label: string, keys: string, action: HeldAction): HTMLButtonElement {
    const b = make("button", { type: "button" }, label, keyCap(keys));
    nameShortcut(b, keys);
    b.title = `${label}: for as long as it is held`;
    const id = `button ${label}`;
    whileHeld(
      b,
      (holder) => {
        this.handlers.hold(`${id} ${holder}`, action);
      },
      (holder) => {
        this.handlers.letGo(`${id} ${holder}`);
      },
    );
    return b;
  }

  private showMode(shown: DragMode): void {
    MODES.forEach(([mode], index) => {
      this.modes[index]?.setAttribute("aria-pressed", String(mode === shown));
    });
  }

  show(driver: Driver, thrustN: number, isCoarse: boolean): void {
    this.forward.setAttribute("aria-pressed", String(driver === "forward"));
    this.reverse.setAttribute("aria-pressed", String(driver === "reverse"));
    this.coarse.setAttribute("aria-pressed", String(isCoarse));
    if (this.slider.value !== String(thrustN)) this.slider.value = String(thrustN);
    setText(this.reading, `${thrustN} N`);
  }
}

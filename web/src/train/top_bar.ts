// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What runs, on whom, how well: one quiet line.
import { button, make, setText } from "../dom";
import { heldText, lostText } from "../devices";
import type { CaseDescription, HandDevice, SnapshotMessage } from "../protocol";
import "./top_bar.css";

export interface TopBarHandlers {
  pause(): void;
  sound(): void;
  help(): void;
  fullScreen(): void;
  devices(): void;
  headset(): void;
}

const WHAT_A_HEADSET_DOES = "Operate with the headset's controllers, in the room";

function tickTimeText(us: number): string {
  return us < 1000 ? `${Math.round(us)} µs` : `${(us / 1000).toFixed(1)} ms`;
}

export class TopBar {
  readonly element: HTMLElement;
  private readonly rate = make("span", {}, "– Hz");
  private readonly p99 = make("span", {}, "p99 –");
  private readonly late = make("span", {}, "late –");
  private readonly device: HTMLButtonElement;
  private page = "mouse and keys";
  private hands: readonly HandDevice[] = [];
  private readonly link = make("span.link-state", { role: "status" });
  private readonly procedure = make("span.secondary.procedure");
  private readonly mode = make("span.badge.mode", { hidden: "" });
  private readonly pauseButton: HTMLButtonElement;
  private readonly soundButton: HTMLButtonElement;
  private readonly headsetButton: HTMLButtonElement;

  constructor(
    private readonly description: CaseDescription,
    handlers: TopBarHandlers,
  ) {
    setText(this.procedure, `${description.side} wrist`);
    this.pauseButton = button("Pause", "{KeyP}", handlers.pause, ".quiet");
    this.soundButton = button("Sound", "{Backquote}", handlers.sound, ".quiet.sound");
    this.headsetButton = button("Headset", "", handlers.headset, ".quiet");
    this.headsetButton.hidden = true;
    this.allowHeadset(undefined);
    this.device = button("mouse and keys", "", handlers.devices, ".quiet.device-held");
    this.device.title = "What the hands hold: choose a device, feel a wall, calibrate";
    const patient = make("span.patient", {}, description.pseudonym);
    if (description.simulated) patient.append(" ", make("span.badge", {}, "simulated"));
    const timing = make("span.timing", {}, this.rate, this.p99, this.late);
    timing.title =
      "Ticks of the simulation per second; time that 99 of 100 ticks stay under; ticks that came late";
    this.element = make(
      "header.top-bar",
      {},
      make("h1.brand", {}, "Carpus"),
      patient,
      this.procedure,
      this.mode,
      this.link,
      timing,
      this.device,
      this.pauseButton,
      this.soundButton,
      this.headsetButton,
      button("Help", "?", handlers.help, ".quiet"),
      button("Full screen", "", handlers.fullScreen, ".quiet"),
    );
  }

  /** With what one operates. */
  showGamepad(on: boolean): void {
    this.page = on ? "gamepad" : "mouse and keys";
    this.showDevices(this.hands);
  }

  /** Whether this browser has a headset. */
  offerHeadset(isThere: boolean): void {
    this.headsetButton.hidden = !isThere;
  }

  /** @param why  what is done is not done with one */
  allowHeadset(why: string | undefined): void {
    this.headsetButton.setAttribute("aria-disabled", String(why !== undefined));
    this.headsetButton.title = why ?? WHAT_A_HEADSET_DOES;
  }

  showHeadset(isWorn: boolean): void {
    this.headsetButton.setAttribute("aria-pressed", String(isWorn));
  }

  /** What the hands hold, and how it is. */
  showDevices(hands: readonly HandDevice[]): void {
    this.hands = hands;
    setText(this.device, heldText(hands, this.page));
    this.device.classList.toggle("lost", lostText(hands) !== "");
  }

  showTiming(s: SnapshotMessage): void {
    // What was measured before the pause says nothing of now.
    setText(this.rate, s.paused ? "– Hz" : `${Math.round(s.tick_rate_hz)} Hz`);
    setText(this.p99, s.paused ? "p99 –" : `p99 ${tickTimeText(s.tick_p99_us)}`);
    setText(this.late, `late ${s.late_ticks}`);
    const label = this.pauseButton.firstChild;
    const wanted = s.paused ? "Resume" : "Pause";
    if (label !== null && label.textContent !== wanted) label.textContent = wanted;
    this.pauseButton.setAttribute("aria-pressed", String(s.paused));
  }

  /** Whether it is wished; a first gesture wakes it. */
  showSound(on: boolean): void {
    this.soundButton.setAttribute("aria-pressed", String(on));
    const label = this.soundButton.firstChild;
    if (label !== null) label.textContent = on ? "Sound" : "Sound off";
    this.soundButton.title = on ? "Motor, screw and C-arm are heard" : "Nothing is heard";
  }

  /** @param title  of the procedure that is done */
  showProcedure(title: string, assessed: boolean): void {
    setText(this.procedure, `${this.description.side} wrist · ${title}`);
    setText(this.mode, assessed ? "assessed" : "practice");
    this.mode.hidden = false;
    this.mode.classList.toggle("assessed", assessed);
  }

  showLink(text: string): void {
    setText(this.link, text);
  }
}

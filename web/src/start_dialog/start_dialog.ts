// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who operates, on which case, and that it is no patient where it is none.
import { button, make, setText } from "../dom";
import type { CaseDescription } from "../protocol";
import "./start_dialog.css";
import { withTimesSigns } from "./times_sign_model";

export interface StartChoice {
  readonly trainee: string;
}

const NAME_KEY = "carpus.trainee";
const MAX_NAME = 64;

function rememberedName(): string {
  try {
    return localStorage.getItem(NAME_KEY) ?? "";
  } catch {
    return ""; // storage may be forbidden; the name is then typed again
  }
}

function rememberName(name: string): void {
  try {
    localStorage.setItem(NAME_KEY, name);
  } catch {
    // storage may be forbidden; the name is then typed again
  }
}

export class StartDialog {
  readonly element: HTMLDialogElement;
  private readonly name: HTMLInputElement;
  private readonly start: HTMLButtonElement;
  private readonly resume: HTMLButtonElement;
  private readonly note = make("p.start-note", { role: "status" });

  constructor(
    description: CaseDescription,
    onStart: (choice: StartChoice) => void,
    onResume: (choice: StartChoice) => void,
  ) {
    this.name = make("input", {
      type: "text",
      id: "trainee-name",
      maxlength: String(MAX_NAME),
      autocomplete: "off",
      spellcheck: "false",
      value: rememberedName(),
    });
    this.start = make("button.primary", { type: "submit" }, "Start");
    this.resume = button("Go on with the running exercise", "", () => {
      onResume(this.choice());
    });
    this.resume.hidden = true;
    const form = make(
      "form",
      { method: "dialog" },
      make(
        "header.start-head",
        {},
        make("img", { src: "/carpus.svg", alt: "", width: "40", height: "40" }),
        make(
          "div",
          {},
          make("h1", { id: "start-title" }, "Carpus"),
          make("p.secondary", {}, "Percutaneous scaphoid fixation, for training"),
        ),
      ),
      this.facts(description),
      make("label", { for: "trainee-name" }, "Your name, for the list of attempts"),
      this.name,
      this.note,
      make(
        "div.actions",
        {},
        make("a.start-link", { href: "#/attempts" }, "Past attempts"),
        this.resume,
        this.start,
      ),
      make("p.start-foot", {}, "For training and research. Not a medical device."),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      onStart(this.choice());
    });
    this.element = make("dialog.start", { "aria-labelledby": "start-title" }, form);
    // Escape has nothing to go back to.
    this.element.addEventListener("cancel", (event) => {
      event.preventDefault();
    });
  }

  private facts(d: CaseDescription): HTMLElement {
    const row = (term: string, ...value: (Node | string)[]): Node[] => [
      make("dt", {}, term),
      make("dd", {}, ...value),
    ];
    const patient: (Node | string)[] = [d.pseudonym];
    if (d.simulated) patient.push(" ", make("span.badge", {}, "simulated"));
    const bone = d.broken_scaphoid
      ? "scaphoid nonunion, both parts as they lie"
      : "scaphoid in one";
    return make(
      "dl.start-facts",
      {},
      ...row("Case", ...patient),
      ...row("Side", `${d.side} wrist, flexed ${Math.round(Math.abs(d.flexion_deg))}°, ${bone}`),
      ...row("From", d.source === "" ? "not stated" : withTimesSigns(d.source)),
      ...row("Procedure", "Dorsal percutaneous fixation, 1.14 mm guide wire, headless screw"),
    );
  }

  private choice(): StartChoice {
    const trainee = this.name.value.trim();
    rememberName(trainee);
    return { trainee };
  }

  open(): void {
    if (this.element.open) return;
    this.element.showModal();
    this.nextStep().focus();
  }

  private nextStep(): HTMLElement {
    return this.resume.hidden ? this.name : this.resume;
  }

  close(): void {
    this.element.close();
  }

  /** Whether the host can take a start now; if not, why. */
  setReady(ready: boolean, note: string): void {
    this.start.disabled = !ready;
    setText(this.note, note);
    this.note.hidden = note === "";
  }

  /** Going on comes before starting anew. */
  offerResume(on: boolean): void {
    if (this.resume.hidden === !on) return;
    this.resume.hidden = !on;
    this.resume.classList.toggle("primary", on);
    this.start.classList.toggle("primary", !on);
    setText(this.start, on ? "Start anew" : "Start");
    if (this.element.open) this.nextStep().focus();
  }
}

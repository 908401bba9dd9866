// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The two questions, asked before anything is shown: where is it out, and which view next?
import { make } from "../dom";
import type { QuizView, ScrewPlace } from "../protocol";
import { PLACES } from "./quiz_model";

export interface QuizChoice {
  readonly place: ScrewPlace;
  readonly view: string;
}

export class AnswerForm {
  readonly element: HTMLFormElement;
  private readonly nextViews = make("fieldset.quiz-choices");
  private readonly send = make("button.primary", { type: "submit" }, "Answer");
  private readonly note = make("p.secondary", { role: "status" });
  private views: readonly QuizView[] = [];
  private taken: ReadonlySet<number> = new Set();

  constructor(onAnswer: (choice: QuizChoice) => void) {
    this.send.append(make("kbd", {}, "Enter"));
    this.element = make(
      "form.quiz-form",
      {},
      make(
        "fieldset.quiz-choices",
        {},
        make("legend", {}, "Is the screw in, or out, and where?"),
        ...PLACES.map((choice) => this.option("place", choice.place, choice.label, choice.key)),
      ),
      this.nextViews,
      make("div.quiz-send", {}, this.send, this.note),
    );
    this.element.addEventListener("change", () => {
      this.refresh();
    });
    this.element.addEventListener("submit", (event) => {
      event.preventDefault();
      const choice = this.choice();
      if (choice !== undefined && !this.send.disabled) onAnswer(choice);
    });
  }

  private option(name: string, value: string, label: string, key: string): HTMLElement {
    const input = make("input", { type: "radio", name, value });
    const text = make("span", {}, label);
    return make("label", {}, input, text, make("kbd", {}, key));
  }

  ask(views: readonly QuizView[]): void {
    this.views = views;
    this.element.reset();
    this.nextViews.replaceChildren(
      make("legend", {}, "Which view would you take next, to be sure?"),
      ...views.map((view, index) => this.option("view", view.id, view.name, `⇧${index + 1}`)),
    );
    this.element.hidden = false;
    this.setTaken(new Set());
  }

  /** Views that were taken are no next ones. */
  setTaken(taken: ReadonlySet<number>): void {
    this.taken = taken;
    this.inputs("view").forEach((input, index) => {
      input.disabled = taken.has(index) && taken.size < this.views.length;
      if (input.disabled) input.checked = false;
    });
    this.refresh();
  }

  choosePlace(index: number): void {
    this.choose("place", index);
  }

  chooseView(index: number): void {
    this.choose("view", index);
  }

  submit(): void {
    this.element.requestSubmit();
  }

  hide(): void {
    this.element.hidden = true;
  }

  private inputs(name: string): HTMLInputElement[] {
    return [...this.element.querySelectorAll<HTMLInputElement>(`input[name=${name}]`)];
  }

  private choose(name: string, index: number): void {
    const input = this.inputs(name)[index];
    if (input === undefined || input.disabled || this.element.hidden) return;
    input.checked = true;
    input.focus();
    this.refresh();
  }

  private choice(): QuizChoice | undefined {
    const place = this.inputs("place").find((input) => input.checked)?.value;
    const view = this.inputs("view").find((input) => input.checked)?.value;
    if (place === undefined || view === undefined) return undefined;
    return { place: place as ScrewPlace, view };
  }

  private refresh(): void {
    this.send.disabled = this.choice() === undefined;
    const count = this.taken.size;
    this.note.textContent = this.send.disabled
      ? "Choose both first."
      : `${count} ${count === 1 ? "view" : "views"} taken.`;
  }
}

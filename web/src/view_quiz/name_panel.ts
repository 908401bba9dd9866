// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Asks whose answers they are before the first question is.
import { make } from "../dom";
import { nameField, rememberName } from "../trainee_name";

export class NamePanel {
  readonly element: HTMLFormElement;
  private readonly field = nameField("quiz-name");
  private readonly begin = make("button.primary", { type: "submit" }, "Begin");

  constructor(onBegin: (name: string) => void) {
    this.element = make(
      "form.quiz-name",
      {},
      make("label", { for: "quiz-name" }, "Your name, which the answers are kept with"),
      this.field,
      this.begin,
    );
    this.element.hidden = true;
    this.element.addEventListener("submit", (event) => {
      event.preventDefault();
      const name = this.field.value.trim();
      rememberName(name);
      onBegin(name);
    });
  }

  get isAsking(): boolean {
    return !this.element.hidden;
  }

  ask(): void {
    this.element.hidden = false;
    this.field.focus();
  }

  hide(): void {
    this.element.hidden = true;
  }

  /** Whether the host can be asked now. */
  setReady(ready: boolean): void {
    this.begin.disabled = !ready;
  }
}

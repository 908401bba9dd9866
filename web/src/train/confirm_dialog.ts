// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A question with two answers, before what cannot be taken back.
import { button, make, setText } from "../dom";
import "./confirm_dialog.css";

export class ConfirmDialog {
  readonly element: HTMLDialogElement;
  private readonly yes: HTMLButtonElement;
  private readonly note = make("p.confirm-note");

  constructor(title: string, text: string, yes: string, onYes: () => void, no = "Go on operating") {
    this.yes = button(
      yes,
      "Enter",
      () => {
        this.element.close();
        onYes();
      },
      ".primary",
    );
    const id = `confirm-${title.toLowerCase().replace(/[^a-z]+/g, "-")}`;
    this.element = make(
      "dialog.confirm",
      { "aria-labelledby": id },
      make(
        "div",
        {},
        make("h2", { id }, title),
        this.note,
        make("p", {}, text),
        make(
          "div.actions",
          {},
          button(no, "Esc", () => {
            this.element.close();
          }),
          this.yes,
        ),
      ),
    );
  }

  /** @param note  what speaks against it now */
  ask(note = ""): void {
    if (this.element.open) return;
    setText(this.note, note);
    this.element.showModal();
    this.yes.focus();
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Not to operate is an answer too, and it needs reasons: those that the procedure knows, all the same to
// look at, for which of them hold is what is asked.
import { button, make } from "../dom";
import type { DeclineReason } from "../protocol";
import "./decline_dialog.css";

export class DeclineDialog {
  readonly element: HTMLDialogElement;
  private readonly reasons = make("fieldset.decline-reasons");
  private readonly yes: HTMLButtonElement;

  constructor(private readonly onYes: (reasons: readonly string[]) => void) {
    this.yes = button("Decline and end", "", () => {}, ".primary");
    this.yes.type = "submit";
    const form = make(
      "form",
      { method: "dialog" },
      make("h2", { id: "decline-title" }, "Decline to operate?"),
      make(
        "p",
        {},
        "What speaks against fixing it through the skin? Say all that holds, and nothing else. This ends the operation.",
      ),
      this.reasons,
      make(
        "div.actions",
        {},
        button("Go on operating", "Esc", () => {
          this.element.close();
        }),
        this.yes,
      ),
    );
    form.addEventListener("change", () => {
      this.yes.disabled = this.chosen.length === 0;
    });
    form.addEventListener("submit", () => {
      this.onYes(this.chosen);
    });
    this.element = make("dialog.confirm.decline", { "aria-labelledby": "decline-title" }, form);
  }

  private get chosen(): readonly string[] {
    const checked = this.reasons.querySelectorAll<HTMLInputElement>("input:checked");
    return [...checked].map((input) => input.value);
  }

  ask(reasons: readonly DeclineReason[]): void {
    if (this.element.open || reasons.length === 0) return;
    this.reasons.replaceChildren(
      make("legend.visually-hidden", {}, "Reasons"),
      ...reasons.map(({ id, label }) =>
        make("label", {}, make("input", { type: "checkbox", value: id }), label),
      ),
    );
    this.yes.disabled = true;
    this.element.showModal();
    this.reasons.querySelector("input")?.focus();
  }
}

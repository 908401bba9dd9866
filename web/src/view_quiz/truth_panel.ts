// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The truth about a question, after its answer.
import { button, make } from "../dom";
import type { QuizTruthMessage, QuizView } from "../protocol";
import { truthText, verdictText, viewVerdictText } from "./quiz_model";

export interface TruthHandlers {
  show(view: number): void;
  outlines(on: boolean): void;
  next(): void;
}

export class TruthPanel {
  readonly element = make("section.quiz-truth", { "aria-label": "The truth" });
  private readonly outlines = make("input", { type: "checkbox" });
  private readonly nextButton: HTMLButtonElement;

  constructor(private readonly handlers: TruthHandlers) {
    this.nextButton = button("Next question", "N", handlers.next, ".primary");
    this.outlines.addEventListener("change", () => {
      handlers.outlines(this.outlines.checked);
    });
    this.element.hidden = true;
  }

  get showsOutlines(): boolean {
    return this.outlines.checked;
  }

  toggleOutlines(): void {
    if (this.element.hidden) return;
    this.outlines.checked = !this.outlines.checked;
    this.handlers.outlines(this.outlines.checked);
  }

  hide(): void {
    this.element.hidden = true;
    this.outlines.checked = false;
  }

  tell(truth: QuizTruthMessage, views: readonly QuizView[]): void {
    const verdict = truth.is_place_right ? "good" : truth.is_false_safety ? "harm" : "acceptable";
    this.element.replaceChildren(
      make(
        "div",
        { role: "status" },
        make(`p.quiz-verdict.${verdict}` as "p", {}, verdictText(truth)),
        make("p", {}, truthText(truth)),
        make(
          `p.${truth.is_view_right ? "good" : "acceptable"}` as "p",
          {},
          viewVerdictText(truth, views),
        ),
      ),
      this.table(truth, views),
      make(
        "p.secondary",
        {},
        `A view reveals metal at least ${truth.revealed_mm.toFixed(1)} mm beyond the bone's outline.`,
      ),
      make(
        "div.quiz-send",
        {},
        make(
          "label.quiz-switch",
          {},
          this.outlines,
          make(
            "span",
            {},
            "Outlines of ",
            make("span.quiz-bone-word", {}, "bone"),
            " and ",
            make("span.quiz-screw-word", {}, "screw"),
          ),
          make("kbd", {}, "O"),
        ),
        this.nextButton,
      ),
    );
    this.element.hidden = false;
    this.nextButton.focus({ preventScroll: true });
  }

  private table(truth: QuizTruthMessage, views: readonly QuizView[]): HTMLElement {
    const rows = truth.views.map((seen) => {
      const index = views.findIndex((view) => view.id === seen.view);
      const isBest = seen.view === truth.best_view;
      const show = button(views[index]?.label ?? seen.view, "", () => {
        this.handlers.show(index);
      });
      show.title = `Show ${views[index]?.name ?? seen.view}`;
      const beyond = seen.overhang_mm > 0 ? `${seen.overhang_mm.toFixed(1)} mm` : "none";
      const isIn = truth.place === "inside";
      const less = seen.overhang_mm > 0 ? "shows too little" : "hides it";
      const says = isIn ? "" : seen.reveals ? "reveals it" : less;
      return make(
        "tr",
        isBest ? { class: "quiz-best" } : {},
        make("th", { scope: "row" }, show),
        make("td.figure", {}, beyond),
        make("td", {}, [says, isBest ? "best" : ""].filter(Boolean).join(", ")),
      );
    });
    const head = ["View", "Metal beyond bone", "So it"].map((text) =>
      make("th", { scope: "col" }, text),
    );
    return make(
      "table",
      {},
      make("thead", {}, make("tr", {}, ...head)),
      make("tbody", {}, ...rows),
    );
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The cases that can be chosen, as cards: picture, title, how hard, what is to be learnt; in an assessed
// operation only what is known of a patient who comes in. Buttons, because an arrow key must not open a
// case.
import { titleAmong } from "../case_data";
import { make } from "../dom";
import type { CaseCard, CaseList, Mode } from "../protocol";
import { cardText } from "./card_text_model";
import "./case_cards.css";

function picture(one: CaseCard): HTMLElement {
  if (!one.has_preview) return make("span.case-card-blank");
  return make("img", {
    src: `/api/cases/${encodeURIComponent(one.id)}/preview.png`,
    alt: "",
    width: "72",
    height: "72",
  });
}

export class CaseCards {
  readonly element = make("section.case-cards", { "aria-label": "Case" });

  constructor(
    private readonly list: CaseList,
    private readonly choose: (id: string) => void,
  ) {}

  /** Nobody is told the diagnosis who is to be assessed by finding it. */
  show(mode: Mode): void {
    const hadFocus = this.element.contains(document.activeElement);
    const cards = this.list.cases.map((one, index) => this.card(one, index, mode));
    this.element.replaceChildren(...cards);
    if (hadFocus) cards.find((card) => card.hasAttribute("aria-current"))?.focus();
  }

  private card(one: CaseCard, index: number, mode: Mode): HTMLElement {
    const title = titleAmong(one, this.list.cases);
    const text = cardText({ ...one, title }, index, mode);
    const element = make(
      "button.case-card",
      { type: "button", "data-case": one.id },
      picture(one),
      make(
        "span.case-card-text",
        {},
        make("strong", {}, text.title),
        make("span.secondary", {}, text.difficulty),
        ...text.doubts.map((doubt) => make("span.case-card-doubt", {}, doubt)),
        make("span.case-card-goal", {}, text.what),
      ),
    );
    const isOpen = one.id === this.list.open;
    if (isOpen) element.setAttribute("aria-current", "true");
    element.addEventListener("click", () => {
      if (!isOpen) this.choose(one.id);
    });
    return element;
  }
}

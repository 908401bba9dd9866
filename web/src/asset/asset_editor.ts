// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An instructor's form: a row of radio buttons a domain with what its steps mean beside them, a name,
// a comment. What was not saved is still there when the page is opened again.
import { fetchAssetForms, saveAssetRating } from "../case_data";
import { button, make, remember, remembered, setText } from "../dom";
import type { AssetForms } from "../protocol";
import { nameProblem } from "../trainee_name";
import {
  COMPLEXITY,
  DOMAINS,
  HIGHEST_TOTAL,
  LEVELS,
  missingRows,
  ROWS,
  standingText,
  stepText,
  totalOf,
  type AssetRow,
} from "./asset_model";
import { draftOf, firstDraft, ratingOf, unseenForm, type Draft } from "./draft_model";
import { forgetDraft, keepDraft, keptDraft, type RatedAttempt } from "./kept_drafts";

const RATER_KEY = "carpus.rater";
const MAX_NAME = 64;
const MAX_COMMENT = 2000;

export class AssetEditor {
  readonly element = make("form.asset-form", { novalidate: "", "aria-label": "Your ASSET form" });
  private draft: Draft;
  private readonly radios = new Map<string, HTMLInputElement>();
  private readonly rater = make("input", {
    type: "text",
    id: "asset-rater",
    maxlength: String(MAX_NAME),
    autocomplete: "off",
    spellcheck: "false",
  });
  private readonly comment = make("textarea", {
    id: "asset-comment",
    rows: "3",
    maxlength: String(MAX_COMMENT),
    dir: "auto",
  });
  private readonly standing = make("p.asset-standing", { "aria-live": "polite" });
  private readonly total = make("strong");
  private readonly unseen = make("p.asset-unseen");
  private readonly save = make("button.primary", { type: "submit" }, "Save");

  /** @param said  where it is told what became of it */
  constructor(
    private readonly attempt: RatedAttempt,
    private forms: AssetForms,
    private readonly said: HTMLElement,
    private readonly onSaved: (forms: AssetForms) => void,
    private readonly onClose: () => void,
  ) {
    const kept = keptDraft(attempt);
    this.draft = kept ?? firstDraft(remembered(RATER_KEY), forms.forms);
    this.element.hidden = kept === undefined;
    this.element.append(
      ...this.rows(),
      make(
        "div.asset-end",
        {},
        make("label", { for: "asset-rater" }, "Your name", this.rater),
        make("label", { for: "asset-comment" }, "Comment, for the trainee", this.comment),
      ),
      this.unseen,
      make(
        "div.asset-sum",
        {},
        make("p.asset-total", {}, this.total, make("span", {}, ` of ${HIGHEST_TOTAL}`)),
        this.standing,
        make(
          "div.actions",
          {},
          button("Close", "", () => {
            this.close();
          }),
          this.save,
        ),
      ),
    );
    this.rater.addEventListener("input", () => {
      this.change({ rater: this.rater.value });
    });
    this.comment.addEventListener("input", () => {
      this.change({ comment: this.comment.value });
    });
    this.element.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.send();
    });
    this.fill();
  }

  get isOpen(): boolean {
    return !this.element.hidden;
  }

  /** It began from a saved form. */
  get amends(): boolean {
    return this.draft.basis !== undefined;
  }

  open(): void {
    this.element.hidden = false;
    this.focusFirst();
  }

  private close(): void {
    this.element.hidden = true;
    this.say(this.draft.isChanged ? "Not saved yet; it is kept until this tab is closed." : "");
    this.onClose();
  }

  private say(text: string, isProblem = false): void {
    this.said.classList.toggle("harm", isProblem);
    setText(this.said, text);
  }

  private rows(): HTMLElement[] {
    const head = make(
      "div.asset-row.asset-head",
      { "aria-hidden": "true" },
      make("span"),
      ...LEVELS.map(([points, word]) =>
        make("span", { style: `grid-column: ${points + 1}` }, `${points} ${word}`),
      ),
    );
    return [head, ...DOMAINS.map((row) => this.row(row)), this.row(COMPLEXITY)];
  }

  private row(row: AssetRow): HTMLElement {
    const points = Array.from({ length: row.highest }, (_, i) => i + 1);
    const isShort = row.steps.length === row.highest;
    return make(
      `div.asset-row${isShort ? ".asset-short" : ""}` as "div",
      {
        role: "radiogroup",
        "aria-labelledby": `asset-${row.id}`,
        "aria-describedby": `asset-${row.id}-about`,
      },
      make(
        "div.asset-domain",
        {},
        make("span", { id: `asset-${row.id}` }, row.title),
        make("small", { id: `asset-${row.id}-about` }, row.about),
      ),
      ...points.map((each) => {
        const radio = make("input", { type: "radio", name: row.id, value: String(each) });
        radio.addEventListener("change", () => {
          this.change({ chosen: new Map(this.draft.chosen).set(row.id, each) });
        });
        this.radios.set(`${row.id} ${each}`, radio);
        const text = row.steps.find((step) => step.points === each)?.text;
        const word = make("b", {}, String(each));
        return make(
          text === undefined ? ("label.asset-between" as "label") : "label",
          {},
          radio,
          word,
          make("span", {}, text ?? stepText(row, each)),
        );
      }),
    );
  }

  private change(by: Partial<Draft>): void {
    this.draft = { ...this.draft, ...by, isChanged: true };
    keepDraft(this.attempt, this.draft);
    this.say("");
    this.tell();
  }

  /** From the draft to all fields. */
  private fill(): void {
    this.rater.value = this.draft.rater;
    this.comment.value = this.draft.comment;
    for (const { id, highest } of ROWS) {
      for (let points = 1; points <= highest; ++points) {
        const radio = this.radios.get(`${id} ${points}`);
        if (radio !== undefined) radio.checked = this.draft.chosen.get(id) === points;
      }
    }
    this.tell();
  }

  private tell(): void {
    const { chosen } = this.draft;
    const name = this.draft.rater.trim();
    this.rater.setCustomValidity(
      name === ""
        ? "Say who rates: forms are told apart by their raters' names."
        : (nameProblem(name) ?? ""),
    );
    setText(this.total, String(totalOf(chosen)));
    setText(this.standing, standingText(chosen));
    setText(this.save, missingRows(chosen).length === 0 ? "Save" : "Save unfinished");
    this.save.disabled = chosen.size === 0;
    const unseen = unseenForm(this.draft, this.forms.forms);
    this.unseen.hidden = unseen === undefined;
    if (unseen === undefined) return;
    this.unseen.replaceChildren(
      `${unseen.rater} has saved a form here. `,
      button("Open it", "", () => {
        this.draft = draftOf(unseen);
        forgetDraft(this.attempt);
        this.say("");
        this.fill();
        this.focusFirst();
      }),
      " in place of what is chosen here, or rate under another name.",
    );
  }

  /** The first row that is missing, else the first. */
  private focusFirst(): void {
    const row = missingRows(this.draft.chosen)[0] ?? DOMAINS[0];
    if (row === undefined) return;
    const chosen = this.draft.chosen.get(row.id) ?? 1;
    this.radios.get(`${row.id} ${chosen}`)?.focus();
  }

  private async send(): Promise<void> {
    if (!this.rater.reportValidity()) return;
    const rating = ratingOf(this.draft);
    this.save.disabled = true;
    this.say("Saving…");
    try {
      this.forms = await saveAssetRating(this.attempt.id, rating);
    } catch (error) {
      this.say(error instanceof Error ? error.message : String(error), true);
      // Perhaps another's form is in the way: then it can be opened.
      this.forms = await fetchAssetForms(this.attempt.id).catch(() => this.forms);
      this.tell();
      return;
    }
    remember(RATER_KEY, rating.rater);
    forgetDraft(this.attempt);
    this.draft = firstDraft(rating.rater, this.forms.forms);
    this.fill();
    this.onSaved(this.forms);
    const missing = missingRows(this.draft.chosen).length;
    if (missing === 0) this.close();
    this.say(
      missing === 0
        ? "✓ Saved. The trainee sees it beside the score; you can amend it."
        : `Saved unfinished: ${missing} ${missing === 1 ? "row is" : "rows are"} missing. The trainee does not see it yet.`,
    );
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The comparison figure by figure. The reports are asked for one after the other, a few at a time, and
// kept: another filter asks for what it does not know yet.
import { fetchAttempt } from "../case_data";
import { make, setText } from "../dom";
import type { AttemptSummary } from "../protocol";
import { GRADE_SIGNS, GRADE_WORDS, valueText } from "../score_report";
import { figureStrip } from "./figure_strip";
import "./figures.css";
import { chosenFor, figureRows, type FigureRow, type Items } from "./figures_model";
import type { ReviewFilter } from "./review_model";

const AT_ONCE = 4;

export class FiguresSection {
  readonly element: HTMLElement;
  private readonly said = make("p.secondary", { role: "status" });
  private readonly table = make("div.table-frame", {
    tabindex: "0",
    role: "region",
    "aria-label": "Table of figures",
  });
  private readonly known = new Map<number, Items>();
  /** Each filter's own: what an earlier one still waits for is passed over. */
  private round = 0;

  /** @param isLeft  nobody looks at it any more */
  constructor(private readonly isLeft: () => boolean) {
    this.table.hidden = true;
    this.element = make(
      "section.review-figures",
      { "aria-labelledby": "figures-title" },
      make("h2", { id: "figures-title" }, "Figure by figure"),
      this.said,
      legend(),
      this.table,
    );
  }

  show(scope: readonly AttemptSummary[], filter: ReviewFilter): void {
    const round = ++this.round;
    const chosen = chosenFor(scope, filter);
    const procedures = new Set(chosen.own.map((attempt) => attempt.procedure));
    this.table.hidden = true;
    this.element.hidden = chosen.own.length === 0;
    if (this.element.hidden) return;
    if (procedures.size > 1) {
      setText(this.said, "Choose one procedure: each has figures of its own.");
      return;
    }
    setText(this.said, "Loading…");
    const isOver = (): boolean => this.isLeft() || round !== this.round;
    void this.load([...chosen.own, ...chosen.expert, ...chosen.group], isOver).then((missing) => {
      if (isOver()) return;
      const itemsOf = (attempts: readonly AttemptSummary[]): Items[] =>
        attempts
          .flatMap(({ id }) => [this.known.get(id) ?? []])
          .filter((items) => items.length > 0);
      const rows = figureRows(
        itemsOf(chosen.own),
        itemsOf(chosen.group),
        itemsOf(chosen.expert),
      ).filter((row) => row.own.length > 0);
      this.table.replaceChildren(table(rows));
      this.table.hidden = rows.length === 0;
      setText(this.said, saidOf(rows.length, chosen.own.length, chosen.group.length, missing));
    });
  }

  /** @return how many could not be read */
  private async load(attempts: readonly AttemptSummary[], isOver: () => boolean): Promise<number> {
    const queue = attempts.map(({ id }) => id).filter((id) => !this.known.has(id));
    let missing = 0;
    const one = async (): Promise<void> => {
      for (let id = queue.shift(); id !== undefined && !isOver(); id = queue.shift()) {
        try {
          this.known.set(id, (await fetchAttempt(id)).score?.items ?? []);
        } catch {
          missing += 1;
        }
      }
    };
    await Promise.all(Array.from({ length: AT_ONCE }, one));
    return missing;
  }
}

function saidOf(rows: number, own: number, group: number, missing: number): string {
  if (rows === 0) return "Of these attempts no figures are known.";
  const others = group === 0 ? "" : `, ${group} of others`;
  const gone = missing === 0 ? "" : `; ${missing} could not be read`;
  return `The last ${own === 1 ? "attempt" : `${own} attempts`}${others}${gone}.`;
}

function legend(): HTMLElement {
  return make(
    "p.secondary.strip-legend",
    {},
    make("span.strip-key.last", {}),
    "last attempt ",
    make("span.strip-key.own", {}),
    "earlier ones, fainter the older ",
    make("span.strip-key.group", {}),
    "middle half of the others ",
    make("span.strip-key.expert", {}),
    "scripted expert, in silico ",
    make("span.strip-key.band", {}),
    "good",
  );
}

function table(rows: readonly FigureRow[]): HTMLElement {
  const heads = ["What", "Where", "Last", "Others, median", "Expert", "Target"];
  return make(
    "table.figure-table",
    {},
    make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head)))),
    make(
      "tbody",
      {},
      ...rows.map((row) => {
        const words = (value: number | undefined): string =>
          value === undefined ? "–" : valueText({ value, unit: row.unit });
        return make(
          "tr",
          { "data-item": row.id },
          make("th", { scope: "row" }, row.label),
          make("td.figure-where", {}, figureStrip(row)),
          make(
            "td.figure",
            {},
            words(row.own.at(-1)),
            make(
              `span.grade.${row.grade}` as "span",
              { title: GRADE_WORDS[row.grade] },
              ` ${GRADE_SIGNS[row.grade]}`,
            ),
          ),
          make("td.figure", {}, words(row.group?.middle)),
          make("td.figure", {}, words(row.expert)),
          make("td.secondary", {}, row.target),
        );
      }),
    ),
  );
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Saved forms side by side, a column a rater; of a single one each choice in words too.
import { dateText } from "../attempts_list";
import { make } from "../dom";
import type { AssetForm } from "../protocol";
import {
  chosenOf,
  COMPLEXITY,
  DOMAINS,
  HIGHEST_TOTAL,
  PASSES_AT,
  stepText,
  verdictText,
  type AssetRow,
} from "./asset_model";

export function formsTable(forms: readonly AssetForm[]): HTMLElement {
  const inWords = forms.length === 1;
  const chosen = forms.map(chosenOf);
  const row = (domain: AssetRow, isCounted: boolean): HTMLElement =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, domain.title, ...(isCounted ? [] : [" ", notCounted()])),
      ...chosen.flatMap((form) => {
        const points = form.get(domain.id);
        const isLow = isCounted && points !== undefined && points < PASSES_AT;
        const figure = make(
          isLow ? ("td.figure.harm" as "td") : "td.figure",
          {},
          points === undefined ? "–" : `${isLow ? "✕ " : ""}${points}`,
        );
        const text = points === undefined ? "not answered" : stepText(domain, points);
        return inWords ? [figure, make("td.secondary", {}, text)] : [figure];
      }),
    );
  const foot = (head: string, value: (form: AssetForm) => string): HTMLElement =>
    make(
      "tr.asset-result",
      {},
      make("th", { scope: "row" }, head),
      ...forms.map((form) =>
        make("td.figure", inWords ? { colspan: "2" } : {}, verdict(form, value(form))),
      ),
    );
  return make(
    "div",
    {},
    make(
      "div.table-frame",
      { tabindex: "0", role: "region", "aria-label": "Forms of the ASSET" },
      make(
        "table.asset-table",
        {},
        make(
          "thead",
          {},
          make(
            "tr",
            {},
            make("td"),
            ...forms.map((form) =>
              make(
                "th",
                { scope: "col", ...(inWords ? { colspan: "2" } : {}) },
                make("bdi", {}, form.rater),
                make("div.asset-date", {}, dateText(form.saved_at)),
              ),
            ),
          ),
        ),
        make(
          "tbody",
          {},
          ...DOMAINS.map((domain) => row(domain, true)),
          foot("Total", (form) =>
            form.total === null ? "–" : `${form.total} of ${HIGHEST_TOTAL}`,
          ),
          foot("By this form", verdictText),
          row(COMPLEXITY, false),
        ),
      ),
    ),
    ...forms.filter(({ comment }) => comment !== "").map(commentOf),
  );
}

function notCounted(): HTMLElement {
  return make("span.secondary", {}, "(not counted)");
}

function verdict(form: AssetForm, text: string): Node | string {
  if (text !== verdictText(form) || form.passes === null) return text;
  return make(`span.${form.passes ? "good" : "harm"}` as "span", {}, text);
}

function commentOf(form: AssetForm): HTMLElement {
  return make(
    "blockquote.asset-comment",
    {},
    make("footer.secondary", {}, make("bdi", {}, form.rater)),
    make("p", { dir: "auto" }, form.comment),
  );
}

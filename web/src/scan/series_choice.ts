// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Several series came together, as on most discs: a person says which is the scan.
import { make } from "../dom";
import { seriesFigures, seriesTitle, type SeriesOffer } from "./new_case_model";

/** @return the place of the chosen one; rejects when it is given up */
export function askForSeries(
  place: HTMLElement,
  series: readonly SeriesOffer[],
  signal: AbortSignal,
): Promise<number> {
  const asked = new Promise<number>((chosen, givenUp) => {
    signal.addEventListener("abort", () => {
      givenUp(new DOMException("given up", "AbortError"));
    });
    const lines = series.map((one, index) => {
      const take = make(
        "button.new-case-series",
        { type: "button" },
        make("strong", {}, seriesTitle(one)),
        make("span.secondary", {}, seriesFigures(one)),
      );
      take.addEventListener("click", () => {
        chosen(index);
      });
      return take;
    });
    place.replaceChildren(
      make(
        "ul.new-case-list",
        { "aria-label": "Series" },
        ...lines.map((line) => make("li", {}, line)),
      ),
    );
    lines[0]?.focus();
  });
  return asked.finally(() => {
    place.replaceChildren();
  });
}

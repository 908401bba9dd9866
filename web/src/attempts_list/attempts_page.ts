// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Past attempts, newest first, a page at a time; each opens its score.
import { fetchAttempts, fetchProcedures } from "../case_data";
import { button, make, setText } from "../dom";
import type { AttemptList, AttemptSummary, ProcedureSummary } from "../protocol";
import { dateText, durationText, procedureText, shownText } from "./attempts_model";

export function mountAttempts(app: HTMLElement): () => void {
  let left = false;
  const body = make("div", {}, make("p.secondary", { role: "status" }, "Loading…"));
  app.replaceChildren(
    make(
      "main.page.attempts",
      {},
      make(
        "header.page-head",
        {},
        make("div", {}, make("p.secondary", {}, "Carpus"), make("h1", {}, "Past attempts")),
        make(
          "nav.page-ways",
          { "aria-label": "Where to" },
          make("a.button-link", { href: "#/review" }, "Learning curve"),
          make("a.button-link.primary", { href: "#/" }, "Operate"),
        ),
      ),
      body,
    ),
  );
  void (async () => {
    try {
      const [first, known] = await Promise.all([fetchAttempts(), fetchProcedures()]);
      if (left) return;
      if (first.attempts.length === 0) body.replaceChildren(nothingYet());
      else body.replaceChildren(...list(first, known));
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      if (!left) body.replaceChildren(make("p", { role: "alert" }, why));
    }
  })();
  return () => {
    left = true;
  };
}

function nothingYet(): HTMLElement {
  return make("p.secondary", {}, "None yet. An attempt is stored when it is finished or left.");
}

/** The table, and what shows more of it. */
function list(first: AttemptList, known: readonly ProcedureSummary[]): HTMLElement[] {
  const rows = make("tbody");
  const shown = make("p.secondary", { role: "status" });
  let last: AttemptSummary | undefined;
  let count = 0;
  const add = (page: AttemptList): void => {
    rows.append(...page.attempts.map((attempt) => row(attempt, known)));
    count += page.attempts.length;
    last = page.attempts.at(-1) ?? last;
    more.hidden = !page.older;
    setText(shown, shownText(count, page.total));
  };
  const more = button("Show older attempts", "", () => {
    more.disabled = true;
    fetchAttempts(last?.id)
      .then(add, (error: unknown) => {
        setText(shown, error instanceof Error ? error.message : String(error));
      })
      .finally(() => {
        more.disabled = false;
      });
  });
  add(first);
  return [table(rows), make("div.actions", {}, shown, more)];
}

function table(rows: HTMLElement): HTMLElement {
  const heads = [
    "No.",
    "Started",
    "Trainee",
    "Case",
    "Procedure",
    "How",
    "Input",
    "Time",
    "Score",
    "Again",
  ];
  return make(
    "div.table-frame",
    { tabindex: "0", role: "region", "aria-label": "Attempts" },
    make(
      "table",
      {},
      make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head)))),
      rows,
    ),
  );
}

function caseCell(attempt: AttemptSummary): (Node | string)[] {
  const badge = make("span.badge", {}, "simulated");
  return attempt.case_simulated === true ? [attempt.case, " ", badge] : [attempt.case];
}

function row(attempt: AttemptSummary, known: readonly ProcedureSummary[]): HTMLElement {
  const score = attempt.overall !== null;
  return make(
    "tr",
    { "data-attempt": String(attempt.id) },
    make("td", {}, String(attempt.id)),
    make("td", {}, dateText(attempt.started_at)),
    make("td", {}, attempt.trainee === "" ? "not named" : attempt.trainee),
    make("td", {}, ...caseCell(attempt)),
    make("td", {}, procedureText(attempt.procedure, known)),
    make("td", {}, attempt.mode ?? ""),
    make("td", {}, attempt.input_device),
    make("td.figure", {}, durationText(attempt.duration_s)),
    make(
      "td.figure",
      {},
      make(
        score ? "a" : "a.secondary",
        { href: `#/attempts/${attempt.id}` },
        score ? `${Math.round(attempt.overall ?? 0)} of 100` : "not finished",
      ),
    ),
    make("td", {}, make("a", { href: `#/replay/${attempt.id}` }, "Replay")),
  );
}

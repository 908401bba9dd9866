// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The review room: whose attempts, how they go on, beside group and expert; out as CSV or JSON.
import { assetText } from "../asset";
import { dateText, durationText, procedureText } from "../attempts_list";
import { fetchAttempts, fetchProcedures, fetchQuizAnswers } from "../case_data";
import { button, make, setText } from "../dom";
import type { AnsweredQuestion, AttemptSummary, ProcedureSummary } from "../protocol";
import { cusum, standing, type CusumPoint } from "./cusum_model";
import { FiguresSection } from "./figures_section";
import { cusumCurve, scoreCurve } from "./learning_curve";
import { playerOf } from "./quiz_answers_model";
import { quizSection } from "./quiz_section";
import { CUSUM_LIMITS, FLAT_AFTER, LIMIT_SOURCES, PROFICIENT_SCORE } from "./review_limits";
import {
  choicesOf,
  compare,
  csvOf,
  finished,
  groupCurve,
  hasFailed,
  inScope,
  isScripted,
  jsonOf,
  madeBy,
  NO_FILTER,
  quantile,
  traineeOf,
  type Comparison,
  type ReviewFilter,
} from "./review_model";
import "./review.css";

/** Of a class in a year; who has more takes the program's own export. */
const MOST_ATTEMPTS = 5000;
const MOST_ANSWERS = 20_000;
const TABLE_ROWS = 60;

export function mountReview(app: HTMLElement): () => void {
  let left = false;
  const main = make("main.page.review", {}, make("p.secondary", { role: "status" }, "Loading…"));
  app.replaceChildren(main);
  void (async () => {
    try {
      const isLeft = (): boolean => left;
      const [attempts, answers, procedures] = await Promise.all([
        fetchAll(isLeft),
        fetchAllAnswers(isLeft),
        fetchProcedures(),
      ]);
      if (!left) new ReviewPage(main, attempts, answers, procedures, isLeft);
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      main.replaceChildren(make("p", { role: "alert" }, why));
    }
  })();
  return () => {
    left = true;
  };
}

async function fetchAll(isLeft: () => boolean): Promise<AttemptSummary[]> {
  const all: AttemptSummary[] = [];
  let older = true;
  while (older && !isLeft() && all.length < MOST_ATTEMPTS) {
    const page = await fetchAttempts(all.at(-1)?.id);
    all.push(...page.attempts);
    older = page.older;
  }
  return all;
}

async function fetchAllAnswers(isLeft: () => boolean): Promise<AnsweredQuestion[]> {
  const all: AnsweredQuestion[] = [];
  let older = true;
  while (older && !isLeft() && all.length < MOST_ANSWERS) {
    const page = await fetchQuizAnswers(all.at(-1)?.id);
    all.push(...page.answers);
    older = page.older && page.answers.length > 0;
  }
  return all;
}

class ReviewPage {
  private filter: ReviewFilter;
  private readonly results = make("div.review-results");
  private readonly said = make("p.secondary", { role: "status" });
  private readonly figures: FiguresSection;

  constructor(
    main: HTMLElement,
    private readonly attempts: readonly AttemptSummary[],
    private readonly answers: readonly AnsweredQuestion[],
    private readonly procedures: readonly ProcedureSummary[],
    isLeft: () => boolean,
  ) {
    this.figures = new FiguresSection(isLeft);
    this.filter = this.firstFilter();
    main.replaceChildren(
      make(
        "header.page-head",
        {},
        make("div", {}, make("p.secondary", {}, "Carpus"), make("h1", {}, "Learning curve")),
        make(
          "nav.page-ways",
          { "aria-label": "Where to" },
          button("CSV", "", () => {
            this.save("csv");
          }),
          button("JSON", "", () => {
            this.save("json");
          }),
          button("Print", "", () => {
            window.print();
          }),
          make("a.button-link", { href: "#/attempts" }, "Past attempts"),
          make("a.button-link.primary", { href: "#/" }, "Operate"),
        ),
      ),
      this.form(),
      this.results,
    );
    this.show();
  }

  /** The one who operated last, on what they did. */
  private firstFilter(): ReviewFilter {
    const last = this.attempts.find((attempt) => !isScripted(attempt)) ?? this.attempts[0];
    const player = this.answers[0];
    if (last === undefined) {
      return player === undefined ? NO_FILTER : { ...NO_FILTER, trainee: playerOf(player) };
    }
    return { ...NO_FILTER, trainee: traineeOf(last), procedure: last.procedure };
  }

  private form(): HTMLElement {
    const select = (
      label: string,
      name: keyof ReviewFilter,
      all: string,
      choices: readonly string[],
      words: (choice: string) => string,
    ): HTMLElement => {
      const field = make(
        "select",
        { name },
        make("option", { value: "" }, all),
        ...choices.map((choice) => make("option", { value: choice }, words(choice))),
      );
      field.value = this.filter[name];
      field.addEventListener("change", () => {
        this.change({ [name]: field.value });
      });
      return make("label", {}, make("span", {}, label), field);
    };
    const day = (label: string, name: "from" | "to"): HTMLElement => {
      const field = make("input", { type: "date", name });
      field.addEventListener("change", () => {
        this.change({ [name]: field.value });
      });
      return make("label", {}, make("span", {}, label), field);
    };
    const same = (text: string): string => text;
    return make(
      "form.review-filter",
      { "aria-label": "Which attempts" },
      select("Trainee", "trainee", "all", this.trainees(), same),
      select(
        "Procedure",
        "procedure",
        "all",
        choicesOf(this.attempts, (attempt) => attempt.procedure),
        (id) => procedureText(id, this.procedures),
      ),
      select(
        "Case",
        "case",
        "all",
        choicesOf(this.attempts, (attempt) => attempt.case),
        same,
      ),
      select("How", "mode", "both", ["practice", "assessed"], same),
      day("From", "from"),
      day("To", "to"),
      this.said,
    );
  }

  /** Who operated, or answered. */
  private trainees(): string[] {
    const names = [...choicesOf(this.attempts, traineeOf), ...this.answers.map(playerOf)];
    return [...new Set(names)].sort((a, b) => a.localeCompare(b, "en"));
  }

  private quiz(): HTMLElement {
    return quizSection(this.answers, this.filter, saveFile);
  }

  private change(by: Partial<ReviewFilter>): void {
    this.filter = { ...this.filter, ...by };
    this.show();
  }

  private get shown(): AttemptSummary[] {
    return madeBy(inScope(this.attempts, this.filter), this.filter, "own");
  }

  private show(): void {
    const scope = inScope(this.attempts, this.filter);
    const own = this.shown;
    const done = finished(own);
    setText(
      this.said,
      `${own.length} ${own.length === 1 ? "attempt" : "attempts"}, ${done.length} finished`,
    );
    if (own.length === 0) {
      this.results.replaceChildren(
        make("p.secondary", {}, "No attempt is like that."),
        this.quiz(),
      );
      return;
    }
    const scores = done.map((attempt) => attempt.overall ?? 0);
    const expert = quantile(
      finished(madeBy(scope, this.filter, "expert")).map((attempt) => attempt.overall ?? 0),
      0.5,
    );
    const points = cusum(done.map(hasFailed), CUSUM_LIMITS);
    const who =
      this.filter.trainee === "" ? "All trainees, one after another" : this.filter.trainee;
    this.results.replaceChildren(
      make(
        "section.review-curves",
        { "aria-labelledby": "curve-title" },
        make("h2", { id: "curve-title" }, who),
        make("p", {}, standingText(points)),
        scoreCurve({
          scores,
          group: groupCurve(scope, this.filter, Math.max(10, scores.length)),
          expert,
          proficient: PROFICIENT_SCORE,
          flatAfter: FLAT_AFTER,
        }),
        cusumCurve(points, CUSUM_LIMITS),
        this.legend(),
      ),
      make(
        "section",
        { "aria-labelledby": "compare-title" },
        make("h2", { id: "compare-title" }, "Compared"),
        comparisonTable(compare(scope, this.filter)),
      ),
      this.figures.element,
      this.quiz(),
      make(
        "section.review-attempts",
        { "aria-labelledby": "attempts-title" },
        make("h2", { id: "attempts-title" }, "Attempts"),
        attemptTable(own, this.procedures),
      ),
      sources(),
    );
    this.figures.show(scope, this.filter);
  }

  private legend(): HTMLElement {
    return make(
      "p.secondary.curve-legend",
      {},
      "● every must-have, ",
      make("span.harm", {}, "✕"),
      " none. The band is the middle half of the others by how many each had done before.",
    );
  }

  private save(kind: "csv" | "json"): void {
    const text = kind === "csv" ? csvOf(this.shown) : jsonOf(this.shown);
    saveFile(text, `carpus-attempts.${kind}`);
  }
}

/** Hands a text out; what kind it is, its name says. */
function saveFile(text: string, name: string): void {
  const type = name.endsWith(".csv") ? "text/csv;charset=utf-8" : "application/json";
  const url = URL.createObjectURL(new Blob([text], { type }));
  make("a", { href: url, download: name }).click();
  URL.revokeObjectURL(url);
}

function standingText(points: readonly CusumPoint[]): string {
  if (points.length === 0) return "None was finished: there is nothing to judge yet.";
  const verdict = standing(points);
  const last = points.map((point) => point.verdict !== "").lastIndexOf(true) + 1;
  if (verdict === "") return "Neither limit was passed yet: go on.";
  return verdict === "proficient"
    ? `✓ At attempt ${last} the lower limit was passed: fails acceptably seldom.`
    : `✕ At attempt ${last} the upper limit was passed: fails too often. Practise on.`;
}

function comparisonTable(rows: readonly Comparison[]): HTMLElement {
  const heads = ["Who", "Finished", "Score, median", "Every must-have", "Time, median"];
  const figure = (value: number | undefined, words: (value: number) => string): HTMLElement =>
    make("td.figure", {}, value === undefined ? "–" : words(value));
  return make(
    "table.review-compare",
    {},
    make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head)))),
    make(
      "tbody",
      {},
      ...rows.map((row) =>
        make(
          "tr",
          {},
          make("th", { scope: "row" }, row.name),
          make("td.figure", {}, String(row.attempts)),
          figure(row.score, (score) => `${Math.round(score)} of 100`),
          figure(row.safe, (safe) => `${Math.round(100 * safe)} %`),
          figure(row.seconds, (seconds) => `${durationText(seconds)} min`),
        ),
      ),
    ),
  );
}

function attemptTable(
  attempts: readonly AttemptSummary[],
  known: readonly ProcedureSummary[],
): HTMLElement {
  const newest = [...attempts].reverse().slice(0, TABLE_ROWS);
  const isRated = newest.some(({ asset }) => asset !== null);
  const heads = [
    ...["No.", "Started", "Trainee", "Case", "Procedure", "How", "Time", "Score"],
    ...(isRated ? ["ASSET"] : []),
    "Again",
  ];
  const more = attempts.length - newest.length;
  return make(
    "div.table-frame",
    { tabindex: "0", role: "region", "aria-label": "Table of attempts" },
    make(
      "table",
      {},
      make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head)))),
      make(
        "tbody",
        {},
        ...newest.map((attempt) =>
          make(
            "tr",
            { "data-attempt": String(attempt.id) },
            make("td", {}, String(attempt.id)),
            make("td", {}, dateText(attempt.started_at)),
            make("td", {}, traineeOf(attempt)),
            make(
              "td",
              {},
              attempt.case,
              ...(attempt.case_simulated === true
                ? [" ", make("span.badge", {}, "simulated")]
                : []),
            ),
            make("td", {}, procedureText(attempt.procedure, known)),
            make("td", {}, attempt.mode ?? ""),
            make("td.figure", {}, durationText(attempt.duration_s)),
            make(
              "td.figure",
              {},
              make(
                "a",
                { href: `#/attempts/${attempt.id}` },
                attempt.overall === null ? "not finished" : `${Math.round(attempt.overall)} of 100`,
              ),
            ),
            ...(isRated ? [make("td.figure", {}, assetText(attempt.asset))] : []),
            make("td", {}, make("a", { href: `#/replay/${attempt.id}` }, "Replay")),
          ),
        ),
      ),
    ),
    ...(more > 0 ? [make("p.secondary", {}, `and ${more} older; all are in the files`)] : []),
  );
}

function sources(): HTMLElement {
  return make(
    "details.review-sources",
    {},
    make("summary", {}, "Where the limits are from"),
    make(
      "dl",
      {},
      ...LIMIT_SOURCES.flatMap(([what, source]) => [make("dt", {}, what), make("dd", {}, source)]),
    ),
    make(
      "p.secondary",
      {},
      "A simulator's figures, not a licence: nothing here was measured on patients.",
    ),
  );
}

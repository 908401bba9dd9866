// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The debrief of one attempt: the placement first, then the figures with target, reason and grade.
// Prints on two pages.
import { dateText, durationText, parseAttempt, procedureText } from "../attempts_list";
import { fetchCase, fetchJson, NotThere } from "../case_data";
import { button, make } from "../dom";
import type { CaseDescription, Json } from "../protocol";
import { attemptedCase, type AttemptedCase } from "./attempted_case_model";
import { eventList } from "./event_list";
import { parseEvents } from "./events_model";
import { itemPicture } from "./item_picture";
import { placementPictures } from "./placement_pictures";
import {
  GRADE_SIGNS,
  GRADE_WORDS,
  longestLineText,
  parseScore,
  valueText,
  type ScoreItem,
  type ScoreReport,
} from "./score_model";
import "./score.css";

export function mountScore(app: HTMLElement, attemptId: number): () => void {
  let left = false;
  const main = make("main.page.score", {}, make("p.secondary", { role: "status" }, "Loading…"));
  app.replaceChildren(main);
  void (async () => {
    try {
      const [json, description] = await Promise.all([
        fetchJson(`/api/attempts/${attemptId}`),
        fetchCase(),
      ]);
      if (!left) show(main, json, description);
    } catch (error) {
      if (left) return;
      const gone = error instanceof NotThere;
      const why = error instanceof Error ? error.message : String(error);
      main.replaceChildren(
        make("h1", {}, gone ? `There is no attempt ${attemptId}` : "This attempt cannot be shown"),
        make("p", { role: "alert" }, gone ? "This station keeps none of that number." : why),
        make("p", {}, make("a", { href: "#/attempts" }, "All past attempts")),
      );
    }
  })();
  return () => {
    left = true;
  };
}

/** The report may be an object or, as it is stored, text. */
function reportOf(json: Json): ScoreReport | undefined {
  if (json === null || typeof json !== "object" || Array.isArray(json)) return undefined;
  const fields = json as { readonly [key: string]: Json };
  const report = fields["score"] ?? fields["report"];
  if (typeof report !== "string") return parseScore(report);
  try {
    return parseScore(JSON.parse(report) as Json);
  } catch {
    return undefined;
  }
}

function show(main: HTMLElement, json: Json, description: CaseDescription): void {
  const fields = json as { readonly [key: string]: Json };
  const attempt = parseAttempt(json) ?? parseAttempt(fields["summary"]);
  const report = reportOf(json);
  const operated = attemptedCase(attempt, description);
  const about =
    attempt === undefined
      ? ""
      : [
          attempt.trainee === "" ? "trainee not named" : attempt.trainee,
          attempt.caseName,
          procedureText(attempt.procedure),
          dateText(attempt.startedAt),
          durationText(attempt.durationS) === "" ? "" : `${durationText(attempt.durationS)} min`,
          attempt.inputDevice,
        ]
          .filter((part) => part !== "")
          .join(" · ");
  const head = make(
    "header.page-head",
    {},
    make(
      "div",
      {},
      make("p.secondary", {}, `Carpus · attempt ${attempt?.id ?? ""}`),
      make("h1", {}, "Score"),
      make("p.secondary", {}, about, operated.simulated ? " " : "", simulatedBadge(operated)),
    ),
    make(
      "nav.page-ways",
      { "aria-label": "Where to" },
      button("Print", "", () => {
        window.print();
      }),
      make("a.button-link", { href: "#/attempts" }, "Past attempts"),
      make("a.button-link.primary", { href: "#/" }, "Operate again"),
    ),
  );
  if (report === undefined) {
    const why = make("p", {}, "This attempt was not finished: there is no score.");
    main.replaceChildren(head, why, eventList(parseEvents(json)));
    return;
  }
  const pictures = make("div.placement", { role: "group", "aria-label": "Placement" });
  main.replaceChildren(
    head,
    make("section.verdict-row", {}, verdict(report), pictures),
    table(report),
    eventList(parseEvents(json)),
    make(
      "p.secondary.score-foot",
      {},
      "Measured on the case's own geometry; simulated training, not a medical device.",
    ),
  );
  if (report.placement === undefined) return;
  if (operated.notice !== "") {
    pictures.append(make("p.secondary", {}, operated.notice));
    return;
  }
  pictures.append(make("p.secondary", { role: "status" }, "Drawing the placement…"));
  placementPictures(description, report.placement).then(
    (figures) => {
      pictures.replaceChildren(...figures, legend(report));
    },
    () => {
      pictures.replaceChildren(make("p.secondary", {}, "The placement cannot be drawn here."));
    },
  );
}

function simulatedBadge(operated: AttemptedCase): Node | string {
  return operated.simulated ? make("span.badge", {}, "simulated") : "";
}

function legend(report: ScoreReport): HTMLElement {
  const axis = make("span.legend-axis", {}, "central axis");
  const length = report.axisLengthMm === undefined ? "" : ` ${report.axisLengthMm.toFixed(1)} mm`;
  return make(
    "p.secondary.legend",
    {},
    axis,
    `${length}, in the scaphoid as it lies; wire and screw in steel.`,
  );
}

function verdict(report: ScoreReport): HTMLElement {
  const figure = (term: string, value: string): Node[] =>
    value === "" ? [] : [make("dt", {}, term), make("dd", {}, value)];
  const mm = (value: number | undefined): string =>
    value === undefined ? "" : `${value.toFixed(1)} mm`;
  return make(
    "div.verdict",
    {},
    make(
      "p.overall",
      {},
      make("strong", {}, String(Math.round(report.overall))),
      make("span", {}, " of 100"),
    ),
    make(
      `p.${report.acceptable ? "good" : "harm"}` as "p",
      {},
      report.acceptable ? "✓ The fixation is acceptable." : "✕ The fixation is not acceptable.",
    ),
    make(
      "ul.must-haves",
      {},
      ...report.mustHaves.map((must) =>
        make(
          "li",
          {},
          make(
            `span.${must.fulfilled ? "good" : "harm"}` as "span",
            {},
            must.fulfilled ? "✓" : "✕",
          ),
          `${must.label}${must.fulfilled ? "" : ": not fulfilled"}`,
        ),
      ),
    ),
    make(
      "dl.lengths",
      {},
      ...figure("True length along the wire", mm(report.trueLengthMm)),
      ...figure("Gauge reading", mm(report.gaugeReadingMm)),
      ...figure("Screw for that length", report.idealScrew),
      ...figure("Screw chosen", report.chosenScrew),
      ...figure("Stands out", report.penetrationAt),
    ),
  );
}

function table(report: ScoreReport): HTMLElement {
  const heads = ["", "What", "Value", "Target", "Grade", "Points", "Why it matters"];
  return make(
    "table.score-table",
    {},
    make("caption.visually-hidden", {}, "Every figure of the score"),
    make(
      "thead",
      {},
      make(
        "tr",
        {},
        ...heads.map((head) => (head === "" ? make("td") : make("th", { scope: "col" }, head))),
      ),
    ),
    make("tbody", {}, ...report.items.map((item) => row(item, report))),
  );
}

function row(item: ScoreItem, report: ScoreReport): HTMLElement {
  const picture = itemPicture(item, report);
  const besides = item.id === "angle_to_central_axis_deg" ? longestLineText(report) : "";
  const points =
    item.pointsPossible === 0
      ? ""
      : `${item.points.toFixed(1)} / ${item.pointsPossible.toFixed(0)}`;
  return make(
    "tr",
    { "data-item": item.id },
    make("td.picture", {}, ...(picture === undefined ? [] : [picture])),
    make(
      "th",
      { scope: "row" },
      item.label,
      ...(besides === "" ? [] : [make("div.secondary", {}, besides)]),
    ),
    make("td.figure", {}, valueText(item)),
    make("td.secondary", {}, item.target),
    make(
      `td.grade.${item.grade}` as "td",
      {},
      `${GRADE_SIGNS[item.grade]} ${GRADE_WORDS[item.grade]}`,
    ),
    make("td.figure", {}, points),
    make("td.reason", {}, item.reason),
  );
}

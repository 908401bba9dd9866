// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The debrief of one attempt: the placement first, then the figures with target, reason and grade.
// Prints on two pages.
import { assetSection } from "../asset";
import { dateText, durationText, procedureText } from "../attempts_list";
import { fetchAttempt, fetchCase, fetchProcedures, NotThere } from "../case_data";
import { button, make } from "../dom";
import type { Attempt, CaseDescription, ScoreItem, ScoreReport } from "../protocol";
import { attemptedCase, type AttemptedCase } from "./attempted_case_model";
import { eventList } from "./event_list";
import { itemPicture } from "./item_picture";
import { placementPictures } from "./placement_pictures";
import { cartilageSection } from "./cartilage_section";
import { makePlacementWorld } from "./placement_world";
import { TurningView } from "./turning_view";
import { viewsSection } from "./views_section";
import { GRADE_SIGNS, GRADE_WORDS, longestLineText, valueText } from "./score_model";
import {
  answerText,
  isDeclined,
  isFixation,
  isRatedByAsset,
  showsCartilage,
  mustHaveWords,
  verdictText,
} from "./verdict_model";
import "./score.css";
import "./score_print.css";

const PLACEMENT_DISTANCE_M = 0.085;

export function mountScore(app: HTMLElement, attemptId: number): () => void {
  let left = false;
  const leaving: (() => void)[] = [];
  const main = make("main.page.score", {}, make("p.secondary", { role: "status" }, "Loading…"));
  app.replaceChildren(main);
  void (async () => {
    try {
      const [attempt, description, procedures] = await Promise.all([
        fetchAttempt(attemptId),
        fetchCase(),
        fetchProcedures(),
      ]);
      const title = procedureText(attempt.procedure, procedures);
      if (left) return;
      show(main, attempt, title, description, {
        isLeft: () => left,
        onLeave: (done) => leaving.push(done),
      });
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
    for (const done of leaving) done();
  };
}

/** Whether the page is left, and what is to be done then. */
interface Staying {
  isLeft(): boolean;
  onLeave(done: () => void): void;
}

function show(
  main: HTMLElement,
  attempt: Attempt,
  procedure: string,
  description: CaseDescription,
  { isLeft, onLeave }: Staying,
): void {
  const report = attempt.score;
  const operated = attemptedCase(attempt, description);
  const about = [
    attempt.trainee === "" ? "trainee not named" : attempt.trainee,
    attempt.case,
    procedure,
    attempt.mode ?? "",
    dateText(attempt.started_at),
    `${durationText(attempt.duration_s)} min`,
    attempt.input_device,
  ]
    .filter((part) => part !== "")
    .join(" · ");
  const head = make(
    "header.page-head",
    {},
    make(
      "div",
      {},
      make("p.secondary", {}, `Carpus · attempt ${attempt.id}`),
      make("h1", {}, "Score"),
      make("p.secondary", {}, about, operated.simulated ? " " : "", simulatedBadge(operated)),
    ),
    make(
      "nav.page-ways",
      { "aria-label": "Where to" },
      button("Print", "", () => {
        window.print();
      }),
      make("a.button-link", { href: "#/review" }, "Learning curve"),
      ...(attempt.case_is_open
        ? [make("a.button-link", { href: `#/replay/${attempt.id}` }, "Replay")]
        : operated.way === ""
          ? []
          : [make("a.button-link", { href: operated.way }, "Open its case")]),
      make("a.button-link", { href: "#/attempts" }, "Past attempts"),
      make("a.button-link.primary", { href: "#/" }, "Operate again"),
    ),
  );
  if (report === null) {
    const why =
      attempt.outcome === "finished"
        ? "The score of this attempt cannot be read."
        : "This attempt was not finished: there is no score.";
    main.replaceChildren(head, make("p", {}, why), eventList(attempt.events));
    return;
  }
  const turning = make("div.turning-place");
  const pictures = make("div.placement", { role: "group", "aria-label": "Placement" });
  main.replaceChildren(
    head,
    make("section.verdict-row", {}, verdict(report), pictures),
    turning,
    table(report),
    make(
      "p.mark",
      {},
      "Where targets come from: [S50] and the like are published sources, by their number in docs/sources.md; [K] is general knowledge without a source, [E] our own estimate.",
    ),
    ...(report.is_void !== true && isRatedByAsset(report)
      ? [assetSection(attempt, { isLeft })]
      : []),
    ...(attempt.case_is_open && report.is_void !== true && isFixation(report)
      ? [viewsSection(attempt)]
      : []),
    ...(attempt.case_is_open && report.is_void !== true && showsCartilage(report)
      ? [cartilageSection(attempt, report, description, { isLeft, onLeave })]
      : []),
    eventList(attempt.events),
    make(
      "p.secondary.score-foot",
      {},
      "Measured on the case's own geometry; simulated training, not a medical device.",
    ),
  );
  if (report.is_void === true || isDeclined(report) || !isFixation(report)) {
    pictures.remove();
    return;
  }
  if (operated.notice !== "") {
    pictures.append(make("p.secondary", {}, operated.notice));
    return;
  }
  pictures.append(make("p.secondary", { role: "status" }, "Drawing the placement…"));
  TurningView.make(
    description,
    (renderer) => makePlacementWorld(renderer, description, report.placement),
    { side: "Radial", distanceM: PLACEMENT_DISTANCE_M },
    { label: "Placement in the scaphoid", caption: "Yellow: entry, white: tip." },
  ).then(
    (placed) => {
      if (isLeft()) placed.dispose();
      else {
        turning.replaceChildren(placed.element);
        onLeave(() => {
          placed.dispose();
        });
      }
    },
    () => {
      turning.remove();
    },
  );
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
  const length = ` ${report.central_axis_length_mm.toFixed(1)} mm`;
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
  const mm = (value: number | null): string => (value === null ? "" : `${value.toFixed(1)} mm`);
  return make(
    "div.verdict",
    {},
    make(
      "p.overall",
      {},
      make("strong", {}, String(Math.round(report.overall))),
      make("span", {}, " of 100"),
    ),
    make(`p.${report.fixation_acceptable ? "good" : "harm"}` as "p", {}, verdictText(report)),
    ...(report.declined_for ?? []).map((reason) => make("p", {}, `Said: ${reason}.`)),
    ...(report.answer === null ? [] : [make("p.case-answer", {}, answerText(report.answer))]),
    make(
      "ul.must-haves",
      {},
      ...report.must_haves.map((must) => {
        const { sign, kind, after } = mustHaveWords(must);
        return make("li", {}, make(`span.${kind}` as "span", {}, sign), `${must.label}${after}`);
      }),
    ),
    make(
      "dl.lengths",
      {},
      ...figure("True length along the wire", mm(report.true_length_mm)),
      ...figure("Gauge reading", mm(report.gauge_reading_mm)),
      ...figure("Screw for that length", report.ideal_screw),
      ...figure("Screw chosen", report.chosen_screw),
      ...figure("Stands out", report.penetration_at),
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
  const picture = itemPicture(item);
  const besides = item.id === "angle_to_central_axis_deg" ? longestLineText(report) : "";
  const points =
    item.points_possible === 0
      ? ""
      : `${item.points.toFixed(1)} / ${item.points_possible.toFixed(0)}`;
  // Nothing is to be said against it: on paper a line without its reason.
  const isPlain = item.grade === "good" || (points === "" && item.grade === "not_measured");
  return make(
    isPlain ? ("tr.plain" as "tr") : "tr",
    { "data-item": item.id },
    make("td.picture", {}, ...(picture === undefined ? [] : [picture])),
    make(
      "th",
      { scope: "row" },
      item.label,
      ...(besides === "" ? [] : [make("div.secondary", {}, besides)]),
    ),
    make("td.figure", {}, valueText(item)),
    make(
      "td.secondary",
      {},
      item.target,
      ...(item.mark === null ? [] : [make("div.mark", {}, `From ${item.mark}`)]),
    ),
    make(
      `td.grade.${item.grade}` as "td",
      {},
      `${GRADE_SIGNS[item.grade]} ${GRADE_WORDS[item.grade]}`,
    ),
    make("td.figure", {}, points),
    make("td.reason", {}, item.reason),
  );
}

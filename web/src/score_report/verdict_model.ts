// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was achieved, in one sentence, and what the case was about.
import type { CaseAnswer, MustHave, RightAnswer, ScoreReport } from "../protocol";

type Told = Pick<
  ScoreReport,
  "fixation_acceptable" | "is_void" | "declined_for" | "central_axis_length_mm"
>;

/** Whether a screw was to go along an axis; else a joint was looked into, and nothing was fixed. */
export function isFixation(report: Pick<ScoreReport, "central_axis_length_mm">): boolean {
  return report.central_axis_length_mm > 0;
}

/** An arthroscopy of a patient, not an exercise of single skills: a person can rate it. */
export function isRatedByAsset(report: Pick<ScoreReport, "items">): boolean {
  return looksIntoJoints(report) || report.items.some(({ id }) => id === "brought_out_share");
}

/** An arthroscopy whose cartilage was looked at. */
export function looksIntoJoints(report: Pick<ScoreReport, "items">): boolean {
  return report.items.some(({ id }) => id === "cartilage_seen_share");
}

/** Where it was looked at, or scuffed by whatever else was done there. */
export function showsCartilage(report: Pick<ScoreReport, "items" | "scuffs">): boolean {
  return looksIntoJoints(report) || (report.scuffs ?? []).length > 0;
}

export function isDeclined(report: Pick<ScoreReport, "declined_for">): boolean {
  return (report.declined_for ?? []).length > 0;
}

export function verdictText(report: Told): string {
  const good = report.fixation_acceptable;
  // Of a declined operation, and of a void one, the axis is not told.
  if (!isFixation(report) && !isDeclined(report)) {
    if (report.is_void === true) {
      return "✕ Void: it ended before there was anything to judge. What is true of this case stays closed.";
    }
    return good
      ? "✓ All conditions below are fulfilled."
      : "✕ A condition below is not fulfilled: nothing earns points without it.";
  }
  if (report.is_void === true) {
    return isDeclined(report)
      ? "✕ Void: it was declined before it was looked at. What is true of this case stays closed."
      : "✕ Void: the operation ended before a screw was in. What is true of this case stays closed.";
  }
  if (isDeclined(report)) {
    return good
      ? "✓ Declined, rightly."
      : "✕ Declined, and not as it should be: nothing earns points without it.";
  }
  return good
    ? "✓ The fixation is acceptable."
    : "✕ The fixation is not acceptable: nothing earns points without it.";
}

/** How a condition is told; one that nothing could be judged by is not said to be broken. */
export function mustHaveWords(must: Pick<MustHave, "fulfilled" | "not_measured">): {
  readonly sign: string;
  readonly kind: "good" | "harm" | "secondary";
  readonly after: string;
} {
  if (must.fulfilled) return { sign: "✓", kind: "good", after: "" };
  if (must.not_measured === true) {
    return {
      sign: "–",
      kind: "secondary",
      after: ": not judged",
    };
  }
  return { sign: "✕", kind: "harm", after: ": not fulfilled" };
}

const ANSWERS: Readonly<Record<RightAnswer, string>> = {
  fix: "Right is to fix it as it lies.",
  reduce_first: "Right is to reduce it first, then to fix it.",
  decline: "Right is to decline, and to say why.",
};

/** "Old humpback: Right is to decline, and to say why. The distal part …" */
export function answerText(answer: CaseAnswer | null): string {
  if (answer === null) return "";
  return `${answer.title}. ${ANSWERS[answer.right_answer]} ${answer.reason}`;
}

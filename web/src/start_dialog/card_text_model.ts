// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a card says of its case.
import { sentence } from "../case_data";
import type { CaseCard, Mode } from "../protocol";

export interface CardText {
  readonly title: string;
  readonly difficulty: string;
  readonly what: string;
  /** What is to be looked at before one operates; none where nothing is. */
  readonly doubts: readonly string[];
}

/** "Check the lunate and the capitate on its scan"; more than three are counted. */
export function doubtText(flagged: readonly string[]): string {
  if (flagged.length === 0) return "";
  const names = flagged.map((name) => `the ${name.replace(/(\d)$/, " $1")}`);
  const last = names.pop() ?? "";
  const which =
    flagged.length > 3
      ? `${flagged.length} bones`
      : names.length === 0
        ? last
        : `${names.join(", ")} and ${last}`;
  return `Check ${which} on its scan`;
}

/** "Difficulty 52 of 100: demanding"; nothing where it was not measured. */
export function difficultyText(difficulty: number | null): string {
  if (difficulty === null) return "";
  const word = difficulty < 40 ? "straightforward" : difficulty < 65 ? "demanding" : "hard";
  return `Difficulty ${Math.round(difficulty)} of 100: ${word}`;
}

/**
 * What is to be known of all of a scan, as it is said there. A body that may be a fragment is for
 * whoever is assessed to find.
 */
export function scanDoubts(ofScan: readonly string[], mode: Mode): readonly string[] {
  if (ofScan.length === 0 || mode === "practice") return ofScan.map(sentence);
  return ["Its scan has warnings, told in practice."];
}

/** In an assessed operation the patient's own words, for title and goal tell the answer. */
export function cardText(one: CaseCard, index: number, mode: Mode): CardText {
  const difficulty = difficultyText(one.difficulty);
  const flagged = doubtText(one.flagged);
  const doubts = [...(flagged === "" ? [] : [flagged]), ...scanDoubts(one.of_scan, mode)];
  return mode === "assessed"
    ? { title: `Case ${index + 1}`, difficulty, doubts, what: one.history }
    : {
        title: one.title,
        difficulty,
        doubts,
        what: one.goal === "" ? "No lesson comes with it." : one.goal,
      };
}

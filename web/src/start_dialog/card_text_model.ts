// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a card says of its case.
import type { CaseCard, Mode } from "../protocol";

export interface CardText {
  readonly title: string;
  readonly difficulty: string;
  readonly what: string;
}

/** "Difficulty 52 of 100: demanding"; nothing where it was not measured. */
export function difficultyText(difficulty: number | null): string {
  if (difficulty === null) return "";
  const word = difficulty < 40 ? "straightforward" : difficulty < 65 ? "demanding" : "hard";
  return `Difficulty ${Math.round(difficulty)} of 100: ${word}`;
}

/** In an assessed operation the patient's own words, for title and goal tell the answer. */
export function cardText(one: CaseCard, index: number, mode: Mode): CardText {
  const difficulty = difficultyText(one.difficulty);
  return mode === "assessed"
    ? { title: `Case ${index + 1}`, difficulty, what: one.history }
    : {
        title: one.title,
        difficulty,
        what: one.goal === "" ? "No lesson comes with it." : one.goal,
      };
}

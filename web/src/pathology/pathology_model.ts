// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an instructor sets before it is saved.
import type { Finding, PathologyWish, PreparedPathology } from "../protocol";

/** A healthy wrist is one of which all was chosen to be well. */
export type PathologyKind = "random" | "healthy" | "chosen" | "seed";

export interface PathologyDraft {
  readonly kind: PathologyKind;
  /** Ids of grades by those of findings; what is missing is well. */
  readonly grades: ReadonlyMap<string, string>;
  /** As typed. */
  readonly seed: string;
}

const WELL = "0";

export function draftOf(prepared: PreparedPathology): PathologyDraft {
  const kind =
    prepared.origin === "chosen" && prepared.grades.length === 0 ? "healthy" : prepared.origin;
  return {
    kind,
    grades: new Map(prepared.grades.map((one) => [one.finding, one.grade])),
    seed: String(prepared.seed ?? 1),
  };
}

export function withGrade(draft: PathologyDraft, finding: string, grade: string): PathologyDraft {
  const grades = new Map(draft.grades);
  if (grade === WELL) grades.delete(finding);
  else grades.set(finding, grade);
  return { ...draft, grades };
}

/** Undefined where the number is none that the host takes. */
function seedOf(draft: PathologyDraft): number | undefined {
  const seed = Number(draft.seed);
  return /^\d+$/.test(draft.seed.trim()) && Number.isSafeInteger(seed) ? seed : undefined;
}

/** Why a draft cannot be saved; empty where it can. */
export function problemOf(draft: PathologyDraft): string {
  if (draft.kind !== "seed" || seedOf(draft) !== undefined) return "";
  return `The number is a whole one from 0 to ${Number.MAX_SAFE_INTEGER}.`;
}

/** Of a draft without a problem. */
export function wishOf(draft: PathologyDraft): PathologyWish {
  const seed = seedOf(draft) ?? null;
  switch (draft.kind) {
    case "random":
      return { origin: "random", seed: null, grades: [] };
    case "healthy":
      return { origin: "chosen", seed, grades: [] };
    case "seed":
      return { origin: "seed", seed, grades: [] };
    case "chosen":
      return {
        origin: "chosen",
        seed,
        grades: [...draft.grades].map(([finding, grade]) => ({ finding, grade })),
      };
  }
}

/** "Scapholunate ligament III, Loose body: there is one"; of a healthy wrist "nothing is wrong". */
export function gradesText(prepared: PreparedPathology, findings: readonly Finding[]): string {
  const parts = findings.flatMap((finding) => {
    const id = prepared.grades.find((one) => one.finding === finding.id)?.grade;
    const grade = finding.grades.find((one) => one.id === id);
    if (grade === undefined) return [];
    return [
      finding.scale === "" ? `${finding.label}: ${grade.label}` : `${finding.label} ${grade.id}`,
    ];
  });
  return parts.length === 0 ? "nothing is wrong" : parts.join(", ");
}

/** What the case holds, in a sentence. */
export function heldText(prepared: PreparedPathology, findings: readonly Finding[]): string {
  if (prepared.origin === "random") return "Each examination draws anew what is wrong.";
  const how = prepared.origin === "seed" ? `Drawn by number ${prepared.seed ?? 0}` : "Prepared";
  return `${how}, the same in each examination: ${gradesText(prepared, findings)}.`;
}

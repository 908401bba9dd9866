// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host's scene says of tendons, arteries and nerves, and which bones carry them: the same
// three as in the host's tick (cases/structures.hpp).

export type StructureKind = "tendon" | "artery" | "nerve";

/** `extras` of a structure's node (docs/case_format.md). */
export interface StructureFacts {
  readonly structure: StructureKind;
  readonly title: string;
  readonly forearm: "radius" | "ulna";
  readonly generated: true;
}

export type Carrier = "radius" | "ulna" | "hand";

const KINDS: readonly string[] = ["tendon", "artery", "nerve"];

export function isStructure(extras: unknown): extras is StructureFacts {
  if (typeof extras !== "object" || extras === null) return false;
  const { structure, title, forearm, generated } = extras as Record<string, unknown>;
  return (
    typeof structure === "string" &&
    KINDS.includes(structure) &&
    typeof title === "string" &&
    (forearm === "radius" || forearm === "ulna") &&
    generated === true
  );
}

/** What a bone carries, if anything. The capitate stands for the hand. */
export function carriedBy(bone: string): Carrier | undefined {
  if (bone === "radius" || bone === "ulna") return bone;
  return bone === "capitate" ? "hand" : undefined;
}

/** Said wherever they are shown. */
export const STRUCTURES_NOTE =
  "Tendons pale blue, arteries red, nerves yellow: generated, not seen in the CT";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which bones the labels hold now, beside those that were found: a known bone that is missing is one too, so
// that it can be taken in hand and painted.
import { KNOWN_BONES, type ScannedBone } from "./scan_case_model";

/** "later": there now, and not when the case was made; "gone": the other way round. */
export type Presence = "found" | "later" | "gone" | "not found";

export interface BoneNow extends ScannedBone {
  readonly presence: Presence;
}

export const SCAPHOID = 3;
export const SCAPHOID_DISTAL = 16;

export const isThere = ({ presence }: BoneNow): boolean =>
  presence === "found" || presence === "later";

/** Of one that is not there, after its name. */
export function whyMissing({ presence, label }: BoneNow): string {
  if (presence === "gone") return "has no voxels any more";
  return label === SCAPHOID_DISTAL ? "is not there: the scaphoid is in one piece" : "was not found";
}

/** As the host will call it: a scaphoid of which there is a distal part is the proximal one. */
export function nameOfLabel(label: number, count: (label: number) => number): string {
  if (label === SCAPHOID && count(SCAPHOID_DISTAL) > 0) return "scaphoid_proximal";
  return KNOWN_BONES.find(([one]) => one === label)?.[1] ?? `label${label}`;
}

/**
 * @param found  the case's own
 * @param count  how many voxels have a label now
 * @return all known bones in the order of their labels; others of the case after them
 */
export function bonesNow(
  found: readonly ScannedBone[],
  count: (label: number) => number,
): readonly BoneNow[] {
  const known = KNOWN_BONES.map(([label]) => label);
  const others = found.map((bone) => bone.label).filter((label) => !known.includes(label));
  return [...known, ...others].map((label): BoneNow => {
    const bone = found.find((one) => one.label === label);
    const isNow = count(label) > 0;
    const blank = { label, confidence: undefined, flagged: false, why: "" };
    const presence =
      bone === undefined ? (isNow ? "later" : "not found") : isNow ? "found" : "gone";
    const name = known.includes(label) ? nameOfLabel(label, count) : (bone?.name ?? "");
    return { ...(bone ?? blank), name, presence };
  });
}

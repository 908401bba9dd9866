// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a case's case.json and trust.json say of its scan and bones (docs/case_format.md); nothing but what is
// shown here.
import { sentence } from "../case_data";
import type { Vec3 } from "../protocol";

export interface ScannedBone {
  /** "scaphoid_proximal" */
  readonly name: string;
  readonly label: number;
  /** How sure the reconstruction is, 0 to 1; undefined in cases that do not tell. */
  readonly confidence: number | undefined;
  readonly flagged: boolean;
  /** Why it is flagged, in words; may be empty. */
  readonly why: string;
}

export interface ScannedCase {
  readonly pseudonym: string;
  readonly simulated: boolean;
  /** Id of the case of which a person corrected the bones; undefined of others. */
  readonly versionOf: string | undefined;
  readonly side: "left" | "right";
  /** Rows of a rotation. */
  readonly wristFromPatient: readonly [Vec3, Vec3, Vec3];
  readonly bones: readonly ScannedBone[];
  /** What is to be known of the scan as a whole, in whole sentences. */
  readonly warnings: readonly string[];
}

type Fields = Readonly<Record<string, unknown>>;

function isFields(value: unknown): value is Fields {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function vector(value: unknown): Vec3 {
  const numbers: unknown[] = Array.isArray(value) ? (value as unknown[]) : [];
  const [x, y, z] = numbers;
  if (typeof x !== "number" || typeof y !== "number" || typeof z !== "number") {
    throw new Error("case.json: wrist_from_patient is no pose");
  }
  return [x, y, z];
}

function bone(value: unknown): ScannedBone {
  if (!isFields(value) || typeof value["name"] !== "string" || typeof value["label"] !== "number") {
    throw new Error("case.json: a bone has no name or label");
  }
  return {
    name: value["name"],
    label: value["label"],
    confidence: undefined,
    flagged: false,
    why: "",
  };
}

/** @throws Error  where it is no case */
export function parseScannedCase(text: string): ScannedCase {
  const json: unknown = JSON.parse(text);
  if (!isFields(json) || json["format"] !== "carpus case") throw new Error("case.json is none");
  const pose = isFields(json["wrist_from_patient"]) ? json["wrist_from_patient"]["rotation"] : [];
  const rows: unknown[] = Array.isArray(pose) ? (pose as unknown[]) : [];
  const bones: unknown[] = Array.isArray(json["bones"]) ? (json["bones"] as unknown[]) : [];
  const provenance = isFields(json["provenance"]) ? json["provenance"] : {};
  const pseudonym = json["pseudonym"];
  const versionOf = provenance["version_of"];
  return {
    pseudonym: typeof pseudonym === "string" ? pseudonym : "",
    simulated: provenance["simulated"] === true,
    versionOf: typeof versionOf === "string" && versionOf !== "" ? versionOf : undefined,
    side: json["side"] === "right" ? "right" : "left",
    wristFromPatient: [vector(rows[0]), vector(rows[1]), vector(rows[2])],
    bones: bones.map(bone),
    warnings: [],
  };
}

/**
 * The same with what trust.json says of each bone.
 * @throws Error  where that is no such file
 */
export function withTrust(scanned: ScannedCase, text: string): ScannedCase {
  const json: unknown = JSON.parse(text);
  if (!isFields(json) || json["format"] !== "carpus bone trust") {
    throw new Error("trust.json is none; reconstruct the case anew");
  }
  const lines: unknown[] = Array.isArray(json["bones"]) ? (json["bones"] as unknown[]) : [];
  const trusted = scanned.bones.map((bone): ScannedBone => {
    const line = lines.find((each) => isFields(each) && each["name"] === bone.name);
    if (!isFields(line)) return bone;
    const confidence = line["confidence"];
    const why = line["why"];
    return {
      ...bone,
      confidence: typeof confidence === "number" ? Math.min(1, Math.max(0, confidence)) : undefined,
      flagged: line["flagged"] === true,
      why: typeof why === "string" ? why : "",
    };
  });
  const ofScan: unknown[] = Array.isArray(json["of_scan"]) ? (json["of_scan"] as unknown[]) : [];
  const warnings = ofScan.filter((text) => typeof text === "string").map(sentence);
  return { ...scanned, bones: trusted, warnings };
}

/** Labels and names as a case has them (src/anatomy/bone_id.hpp). */
export const KNOWN_BONES: readonly (readonly [number, string])[] = [
  [1, "radius"],
  [2, "ulna"],
  [3, "scaphoid"],
  [4, "lunate"],
  [5, "triquetrum"],
  [6, "pisiform"],
  [7, "trapezoid"],
  [8, "trapezium"],
  [9, "capitate"],
  [10, "hamate"],
  [11, "metacarpal1"],
  [12, "metacarpal2"],
  [13, "metacarpal3"],
  [14, "metacarpal4"],
  [15, "metacarpal5"],
  [16, "scaphoid_distal"],
];

/** "Scaphoid, proximal part", "Metacarpal 1" */
export function boneTitle(name: string): string {
  const [whole = "", part] = name.split("_");
  const words = whole.replace(/(\d)$/, " $1");
  const title = words.charAt(0).toUpperCase() + words.slice(1);
  return part === undefined ? title : `${title}, ${part} part`;
}

/** Far apart from neighbour to neighbour, on black and on grey: 0xbbggrr by label. */
export function labelColors(): Uint32Array {
  const colors = new Uint32Array(256);
  // Neighbours in the carpus have hues far apart; labels as in src/anatomy/bone_id.hpp.
  const known = [
    "e0b45c",
    "66a9e0",
    "ef6f6c",
    "6fd08c",
    "b68cf0",
    "f2e06a",
    "4fd3d8",
    "f09a4e",
    "e783c2",
    "8fd14f",
    "7d9bff",
    "ffb3a1",
    "58c9a3",
    "c9a0dc",
    "d9d36f",
    "ff5da2",
  ];
  for (let label = 1; label < 256; ++label) {
    const hex = known[(label - 1) % known.length] ?? "ffffff";
    const rgb = parseInt(hex, 16);
    colors[label] = ((rgb & 255) << 16) | (rgb & 0xff00) | (rgb >>> 16);
  }
  return colors;
}

/** As a style has it. */
export function cssColor(color: number): string {
  return `rgb(${color & 255} ${(color >>> 8) & 255} ${(color >>> 16) & 255})`;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The score report as the host stores it (docs/scoring.md), read without trust: what is missing or
// malformed is left out, never guessed.
import type { Json, Vec3 } from "../protocol";

export type Grade = "good" | "acceptable" | "fail" | "not_measured";

export interface ScoreItem {
  readonly id: string;
  readonly label: string;
  readonly value: number | undefined;
  readonly unit: string;
  readonly target: string;
  readonly grade: Grade;
  readonly points: number;
  readonly pointsPossible: number;
  readonly reason: string;
}

export interface MustHave {
  readonly label: string;
  readonly fulfilled: boolean;
}

export interface Placement {
  readonly axisProximalMm: Vec3;
  readonly axisDistalMm: Vec3;
  readonly wire: { readonly entryMm: Vec3; readonly tipMm: Vec3 } | undefined;
  readonly screw:
    | {
        readonly tailMm: Vec3;
        readonly tipMm: Vec3;
        readonly tipDiameterMm: number;
        readonly tailDiameterMm: number;
      }
    | undefined;
}

export interface ScoreReport {
  readonly overall: number;
  readonly acceptable: boolean;
  readonly mustHaves: readonly MustHave[];
  readonly items: readonly ScoreItem[];
  readonly axisLengthMm: number | undefined;
  readonly longestLineMm: number | undefined;
  readonly angleToLongestLineDeg: number | undefined;
  readonly cylinderRadiusMm: number | undefined;
  readonly trueLengthMm: number | undefined;
  readonly gaugeReadingMm: number | undefined;
  readonly idealScrew: string;
  readonly chosenScrew: string;
  readonly penetrationAt: string;
  readonly placement: Placement | undefined;
}

type Fields = { readonly [key: string]: Json };

function fieldsOf(json: Json | undefined): Fields | undefined {
  if (json === null || typeof json !== "object" || Array.isArray(json)) return undefined;
  return json as Fields;
}
function number(json: Json | undefined): number | undefined {
  return typeof json === "number" && Number.isFinite(json) ? json : undefined;
}
function text(json: Json | undefined): string {
  return typeof json === "string" ? json : "";
}
function list(json: Json | undefined): readonly Json[] {
  return Array.isArray(json) ? (json as readonly Json[]) : [];
}
function point(json: Json | undefined): Vec3 | undefined {
  const [x, y, z] = list(json).map(number);
  return x === undefined || y === undefined || z === undefined ? undefined : [x, y, z];
}

function gradeOf(json: Json | undefined): Grade {
  return json === "good" || json === "acceptable" || json === "fail" ? json : "not_measured";
}

function itemOf(json: Json): ScoreItem | undefined {
  const item = fieldsOf(json);
  if (item === undefined) return undefined;
  const id = text(item["id"]);
  const label = text(item["label"]);
  if (id === "" && label === "") return undefined;
  return {
    id,
    label: label === "" ? id : label,
    value: number(item["value"]),
    unit: text(item["unit"]),
    target: text(item["target"]),
    grade: gradeOf(item["grade"]),
    points: number(item["points"]) ?? 0,
    pointsPossible: number(item["points_possible"]) ?? 0,
    reason: text(item["reason"]),
  };
}

function placementOf(json: Json | undefined): Placement | undefined {
  const placement = fieldsOf(json);
  const axis = fieldsOf(placement?.["central_axis"]);
  const axisProximalMm = point(axis?.["proximal_mm"]);
  const axisDistalMm = point(axis?.["distal_mm"]);
  if (axisProximalMm === undefined || axisDistalMm === undefined) return undefined;
  const wire = fieldsOf(placement?.["wire"]);
  const entryMm = point(wire?.["entry_mm"]);
  const wireTipMm = point(wire?.["tip_mm"]);
  const screw = fieldsOf(placement?.["screw"]);
  const tailMm = point(screw?.["tail_mm"]);
  const tipMm = point(screw?.["tip_mm"]);
  const tipDiameterMm = number(screw?.["tip_diameter_mm"]);
  const tailDiameterMm = number(screw?.["tail_diameter_mm"]);
  return {
    axisProximalMm,
    axisDistalMm,
    wire:
      entryMm === undefined || wireTipMm === undefined ? undefined : { entryMm, tipMm: wireTipMm },
    screw:
      tailMm === undefined ||
      tipMm === undefined ||
      tipDiameterMm === undefined ||
      tailDiameterMm === undefined
        ? undefined
        : { tailMm, tipMm, tipDiameterMm, tailDiameterMm },
  };
}

/** Nothing where there is no report at all: an attempt that was not finished. */
export function parseScore(json: Json | undefined): ScoreReport | undefined {
  const report = fieldsOf(json);
  const overall = number(report?.["overall"]);
  if (report === undefined || overall === undefined) return undefined;
  const mustHaves = list(report["must_haves"]).flatMap((entry): MustHave[] => {
    const must = fieldsOf(entry);
    return must === undefined
      ? []
      : [{ label: text(must["label"]), fulfilled: must["fulfilled"] === true }];
  });
  return {
    overall,
    acceptable: report["fixation_acceptable"] === true,
    mustHaves,
    items: list(report["items"]).flatMap((entry) => itemOf(entry) ?? []),
    axisLengthMm: number(report["central_axis_length_mm"]),
    longestLineMm: number(report["longest_line_mm"]),
    angleToLongestLineDeg: number(report["angle_to_longest_line_deg"]),
    cylinderRadiusMm: number(report["central_cylinder_radius_mm"]),
    trueLengthMm: number(report["true_length_mm"]),
    gaugeReadingMm: number(report["gauge_reading_mm"]),
    idealScrew: text(report["ideal_screw"]),
    chosenScrew: text(report["chosen_screw"]),
    penetrationAt: text(report["penetration_at"]),
    placement: placementOf(report["placement"]),
  };
}

/** What stands beside the angle to the central axis: the other line that a screw is judged by. */
export function longestLineText(
  report: Pick<ScoreReport, "longestLineMm" | "angleToLongestLineDeg">,
): string {
  const { longestLineMm: length, angleToLongestLineDeg: angle } = report;
  if (length === undefined) return "";
  const line = `the longest line through the bone, ${valueText({ value: length, unit: "mm" })}`;
  return `To ${line}: ${valueText({ value: angle, unit: "deg" })}`;
}

/** A value with its unit, for people: "4.2 mm", "3", "2 min 5 s", "not measured". */
export function valueText(item: Pick<ScoreItem, "value" | "unit">): string {
  const { value, unit } = item;
  if (value === undefined) return "not measured";
  if (unit === "s") {
    const seconds = Math.round(value);
    const minutes = Math.floor(seconds / 60);
    return minutes === 0 ? `${seconds} s` : `${minutes} min ${seconds % 60} s`;
  }
  if (unit === "1" || unit === "") return String(Math.round(100 * value) / 100);
  if (unit === "deg") return `${value.toFixed(1)}°`;
  return `${value.toFixed(1)} ${unit.replace("cm2", "cm²")}`;
}

export const GRADE_WORDS: Readonly<Record<Grade, string>> = {
  good: "good",
  acceptable: "acceptable",
  fail: "not reached",
  not_measured: "not measured",
};

export const GRADE_SIGNS: Readonly<Record<Grade, string>> = {
  good: "✓",
  acceptable: "○",
  fail: "✕",
  not_measured: "–",
};

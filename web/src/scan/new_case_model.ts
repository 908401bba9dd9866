// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host tells of a new case while it is made, checked, and in words.

/** One of several series that were brought, as a person tells them apart. */
export interface SeriesOffer {
  readonly description: string;
  readonly slices: number;
  /** 0 where it is not known. */
  readonly spacingMm: readonly number[];
}

export interface NewCaseState {
  readonly state: string;
  readonly doing: string;
  /** 0 to 1 */
  readonly fraction: number;
  readonly id: string;
  readonly problem: string;
  /** Of which one must be chosen while the state is "choosing". */
  readonly series: readonly SeriesOffer[];
}

type Json = Readonly<Record<string, unknown>>;

function word(json: Json, name: string): string {
  const value = json[name];
  return typeof value === "string" ? value : "";
}

function number(value: unknown): number {
  return typeof value === "number" && Number.isFinite(value) ? value : 0;
}

function list(value: unknown): readonly unknown[] {
  return Array.isArray(value) ? value : [];
}

export function parseState(text: string): NewCaseState {
  const json = JSON.parse(text) as Json;
  return {
    state: word(json, "state"),
    doing: word(json, "doing"),
    fraction: Math.min(1, Math.max(0, number(json["fraction"]))),
    id: word(json, "id"),
    problem: word(json, "problem"),
    series: list(json["series"]).map((each) => {
      const one = each as Json;
      return {
        description: word(one, "description"),
        slices: number(one["slices"]),
        spacingMm: list(one["spacing_mm"]).map(number),
      };
    }),
  };
}

export function seriesTitle(one: SeriesOffer): string {
  return one.description.trim() === "" ? "without a description" : one.description;
}

export function seriesFigures(one: SeriesOffer): string {
  const isKnown = one.spacingMm.length === 3 && one.spacingMm.every((mm) => mm > 0);
  const voxels = isKnown
    ? `voxels of ${one.spacingMm.map((mm) => mm.toFixed(2)).join(" × ")} mm`
    : "spacing not known";
  return `${one.slices} slices, ${voxels}`;
}

export function progressText(what: string, part: number): string {
  return `${what}: ${Math.round(100 * part)} %`;
}

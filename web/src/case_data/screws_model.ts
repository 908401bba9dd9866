// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The catalogue of screws as the host lists it.
import type { Json } from "../protocol";

export interface Screw {
  /** Position in the host's catalogue. */
  readonly index: number;
  readonly name: string;
  readonly lengthMm: number;
  readonly tipDiameterMm: number;
  readonly tailDiameterMm: number;
  /** Whether its figures were checked against the maker's guide. */
  readonly confirmed: boolean;
}

/** The well-formed screws of `/api/screws`; their positions are kept where one is passed over. */
export function parseScrews(json: Json): Screw[] {
  const list = Array.isArray(json) ? json : isObject(json) ? json["screws"] : [];
  if (!Array.isArray(list)) return [];
  const screws: Screw[] = [];
  (list as readonly Json[]).forEach((entry, position) => {
    if (!isObject(entry)) return;
    const lengthMm = entry["length_mm"];
    const tip = entry["tip_diameter_mm"];
    const tail = entry["tail_diameter_mm"];
    const name = entry["name"];
    if (typeof lengthMm !== "number" || typeof tip !== "number" || typeof tail !== "number") return;
    const index = typeof entry["index"] === "number" ? entry["index"] : position;
    screws.push({
      index,
      name: typeof name === "string" ? name : `${lengthMm} mm`,
      lengthMm,
      tipDiameterMm: tip,
      tailDiameterMm: tail,
      confirmed: entry["confirmed"] === true,
    });
  });
  return screws;
}

function isObject(json: Json | undefined): json is { readonly [key: string]: Json } {
  return json !== null && typeof json === "object" && !Array.isArray(json);
}

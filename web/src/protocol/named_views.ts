// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The views that the host offers: `views` of the case description.
import type { Json } from "./generated";

export interface NamedView {
  readonly id: string;
  readonly label: string;
  readonly rotationDeg: number;
  readonly tiltDeg: number;
}

/** The well-formed views of the list, in order; anything else in it is passed over. */
export function parseViews(json: Json): NamedView[] {
  if (!Array.isArray(json)) return [];
  const views: NamedView[] = [];
  for (const entry of json as readonly Json[]) {
    if (entry === null || typeof entry !== "object" || Array.isArray(entry)) continue;
    const fields = entry as { readonly [key: string]: Json };
    const { id, label, rotation_deg: rotationDeg, tilt_deg: tiltDeg } = fields;
    if (typeof id !== "string" || typeof label !== "string") continue;
    if (typeof rotationDeg !== "number" || typeof tiltDeg !== "number") continue;
    if (!Number.isFinite(rotationDeg) || !Number.isFinite(tiltDeg)) continue;
    views.push({ id, label, rotationDeg, tiltDeg });
  }
  return views;
}

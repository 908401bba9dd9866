// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What happened in an attempt, as the host stored it (docs/json.md).
import type { Json } from "../protocol";

export interface AttemptEvent {
  readonly tickMs: number;
  readonly text: string;
}

/** Passes over what is no event. @param attempt  what /api/attempts/<id> answers */
export function parseEvents(attempt: Json): readonly AttemptEvent[] {
  if (attempt === null || typeof attempt !== "object" || Array.isArray(attempt)) return [];
  const { events } = attempt as { readonly events?: Json };
  if (!Array.isArray(events)) return [];
  return events.flatMap((event: Json): AttemptEvent[] => {
    if (event === null || typeof event !== "object" || Array.isArray(event)) return [];
    const { tick, text } = event as { readonly tick?: Json; readonly text?: Json };
    return typeof tick === "number" && tick >= 0 && typeof text === "string" && text !== ""
      ? [{ tickMs: tick, text }]
      : [];
  });
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Past attempts as the host lists them.
import type { Json } from "../protocol";

export interface AttemptSummary {
  readonly id: number;
  readonly trainee: string;
  readonly caseName: string;
  /** Whether the station serves that case now; false too where the host does not say, as in the list. */
  readonly caseIsOpen: boolean;
  /** Not scanned from a person; undefined where nobody noted it. */
  readonly caseSimulated: boolean | undefined;
  readonly procedure: string;
  readonly inputDevice: string;
  readonly startedAt: string;
  readonly finished: boolean;
  readonly overall: number | undefined;
  readonly durationS: number | undefined;
  readonly stateHash: string;
}

type Fields = { readonly [key: string]: Json };

function asFields(json: Json | undefined): Fields | undefined {
  if (json === null || typeof json !== "object" || Array.isArray(json)) return undefined;
  return json as Fields;
}

export function parseAttempt(json: Json | undefined): AttemptSummary | undefined {
  const fields = asFields(json);
  const id = fields?.["id"] ?? fields?.["attempt_id"];
  if (fields === undefined || typeof id !== "number") return undefined;
  const text = (name: string): string => {
    const value = fields[name];
    return typeof value === "string" ? value : "";
  };
  const number = (name: string): number | undefined => {
    const value = fields[name];
    return typeof value === "number" && Number.isFinite(value) ? value : undefined;
  };
  const simulated = fields["case_simulated"];
  const ticks = number("duration_ticks") ?? number("duration_ms");
  const durationS = number("duration_s") ?? (ticks === undefined ? undefined : ticks / 1000);
  return {
    id,
    trainee: text("trainee"),
    caseName: text("case_name") === "" ? text("case") : text("case_name"),
    caseIsOpen: fields["case_is_open"] === true,
    caseSimulated: typeof simulated === "boolean" ? simulated : undefined,
    procedure: text("procedure"),
    inputDevice: text("input_device"),
    startedAt: text("started_at"),
    finished: text("outcome") === "finished",
    overall: number("overall"),
    durationS,
    stateHash: text("state_hash"),
  };
}

export function parseAttempts(json: Json): AttemptSummary[] {
  const list = Array.isArray(json) ? json : asFields(json)?.["attempts"];
  if (!Array.isArray(list)) return [];
  return (list as readonly Json[]).flatMap((entry) => parseAttempt(entry) ?? []);
}

/** "21 Nov 2026, 03:15", in the reader's own time; the text as it is where it is no date. */
export function dateText(iso: string): string {
  const date = new Date(iso);
  if (Number.isNaN(date.getTime())) return iso;
  return date.toLocaleString("en-GB", {
    day: "numeric",
    month: "short",
    year: "numeric",
    hour: "2-digit",
    minute: "2-digit",
  });
}

export function durationText(seconds: number | undefined): string {
  if (seconds === undefined) return "";
  const whole = Math.round(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

export function procedureText(id: string): string {
  return id === "dorsal_scaphoid_fixation" ? "Dorsal scaphoid fixation" : id;
}

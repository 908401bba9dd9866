// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// HTTP questions to the host; every answer is checked before use.
import {
  parseAttempt,
  parseAttemptList,
  parseCaseDescription,
  parseProcedureList,
  type Attempt,
  type AttemptList,
  type CaseDescription,
  type Parsed,
  type ProcedureSummary,
} from "../protocol";

export class HostUnreachable extends Error {}
/** The host is well and has no such thing: loading again does not help. */
export class NotThere extends Error {}

async function getText(path: string): Promise<string> {
  let answer: Response;
  try {
    answer = await fetch(path, { headers: { Accept: "application/json" } });
  } catch {
    throw new HostUnreachable("The host does not answer. Is `carpus serve` running?");
  }
  if (answer.status === 404) throw new NotThere(`The host has no ${path}.`);
  if (!answer.ok) {
    throw new HostUnreachable(`The host answered ${answer.status} to ${path}. Reload the page.`);
  }
  return answer.text();
}

async function ask<T>(path: string, parse: (text: string) => Parsed<T>): Promise<T> {
  const parsed = parse(await getText(path));
  if (parsed.ok) return parsed.value;
  throw new HostUnreachable(
    `The host's answer to ${path} cannot be read: ${parsed.reason}. Reload the page.`,
  );
}

export function fetchCase(): Promise<CaseDescription> {
  return ask("/api/case", parseCaseDescription);
}

/** What can be practised on the case. */
export async function fetchProcedures(): Promise<readonly ProcedureSummary[]> {
  return (await ask("/api/procedures", parseProcedureList)).procedures;
}

/** A page, newest first. @param before  the number of an attempt: those that are older. */
export function fetchAttempts(before?: number): Promise<AttemptList> {
  const query = before === undefined ? "" : `?before=${before}`;
  return ask(`/api/attempts${query}`, parseAttemptList);
}

export function fetchAttempt(id: number): Promise<Attempt> {
  return ask(`/api/attempts/${id}`, parseAttempt);
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// HTTP questions to the host; every answer is checked before use.
import { parseCaseDescription, type CaseDescription, type Json } from "../protocol";
import { parseScrews, type Screw } from "./screws_model";

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

export async function fetchJson(path: string): Promise<Json> {
  const text = await getText(path);
  try {
    return JSON.parse(text) as Json;
  } catch {
    throw new HostUnreachable(`The host's answer to ${path} is no JSON. Reload the page.`);
  }
}

export async function fetchCase(): Promise<CaseDescription> {
  const parsed = parseCaseDescription(await getText("/api/case"));
  if (!parsed.ok) throw new HostUnreachable(`The case cannot be read: ${parsed.reason}`);
  return parsed.value;
}

export async function fetchScrews(): Promise<Screw[]> {
  return parseScrews(await fetchJson("/api/screws"));
}

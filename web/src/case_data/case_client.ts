// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// HTTP questions to the host; every answer is checked before use.
import {
  parseAssetForms,
  parseAttempt,
  parseAttemptList,
  parseCArmPicture,
  parseCaseDescription,
  parseCaseList,
  parseCasePathology,
  parsePictureTruth,
  parseProcedureList,
  parseQuizAnswerList,
  parseSeenCartilage,
  parseViewDebrief,
  type AssetForms,
  type AssetRating,
  type Attempt,
  type AttemptList,
  type CArmPicture,
  type CaseDescription,
  type CaseList,
  type CasePathology,
  type Parsed,
  type PathologyWish,
  type PictureTruth,
  type ProcedureSummary,
  type QuizAnswerList,
  type SeenCartilage,
  type ViewDebrief,
} from "../protocol";

export class HostUnreachable extends Error {}
/** The host is well and has no such thing: loading again does not help. */
export class NotThere extends Error {}

async function get(path: string): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(path, { headers: { Accept: "application/json" } });
  } catch {
    throw new HostUnreachable("The host does not answer. Is `carpus serve` running?");
  }
  if (answer.status === 404) throw new NotThere(`The host has no ${path}.`);
  // It says why, for people: the recording is another program's, or of another case.
  if (answer.status === 409) throw new Error((await answer.text()).trim());
  if (!answer.ok) {
    throw new HostUnreachable(`The host answered ${answer.status} to ${path}. Reload the page.`);
  }
  return answer;
}

async function ask<T>(path: string, parse: (text: string) => Parsed<T>): Promise<T> {
  const parsed = parse(await (await get(path)).text());
  if (parsed.ok) return parsed.value;
  throw new HostUnreachable(
    `The host's answer to ${path} cannot be read: ${parsed.reason}. Reload the page.`,
  );
}

export function fetchCase(): Promise<CaseDescription> {
  return ask("/api/case", parseCaseDescription);
}

/** Those that can be chosen, and which is open. */
export function fetchCases(): Promise<CaseList> {
  return ask("/api/cases", parseCaseList);
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

/** A page, newest first. @param before  the number of an answer: those that are older. */
export function fetchQuizAnswers(before?: number): Promise<QuizAnswerList> {
  const query = before === undefined ? "" : `?before=${before}`;
  return ask(`/api/quiz_answers${query}`, parseQuizAnswerList);
}

export function fetchAttempt(id: number): Promise<Attempt> {
  return ask(`/api/attempts/${id}`, parseAttempt);
}

/** How instructors rated an attempt; to a trainee the finished forms. */
export function fetchAssetForms(id: number): Promise<AssetForms> {
  return ask(`/api/asset?attempt=${id}`, parseAssetForms);
}

/** Stores what was set here. @return what the host then holds */
async function put<T>(path: string, body: unknown, parse: (text: string) => Parsed<T>): Promise<T> {
  let answer: Response;
  try {
    answer = await fetch(path, { method: "PUT", body: JSON.stringify(body) });
  } catch {
    throw new HostUnreachable(
      "Not saved: the host does not answer. The form stays here; save it again when it does.",
    );
  }
  const text = await answer.text();
  // The host says why, for people.
  if (!answer.ok) throw new Error(`Not saved: ${text.trim()}`);
  const parsed = parse(text);
  if (parsed.ok) return parsed.value;
  throw new HostUnreachable(`The host's answer cannot be read: ${parsed.reason}. Reload the page.`);
}

/** Stores a form, or amends the one that it began from. @return all of the attempt's */
export function saveAssetRating(id: number, rating: AssetRating): Promise<AssetForms> {
  return put(`/api/asset?attempt=${id}`, rating, parseAssetForms);
}

/** Whether who looks at this page is an instructor, who prepares cases; no case's is told. */
export async function mayPrepareCases(): Promise<boolean> {
  return (await ask("/api/pathology", parseCasePathology)).may_prepare;
}

function pathologyOf(caseId: string): string {
  return `/api/pathology?case=${encodeURIComponent(caseId)}`;
}

/** What a case has prepared to be wrong; the host refuses whoever is no instructor. */
export function fetchCasePathology(caseId: string): Promise<CasePathology> {
  return ask(pathologyOf(caseId), parseCasePathology);
}

export function savePathology(caseId: string, wish: PathologyWish): Promise<CasePathology> {
  return put(pathologyOf(caseId), wish, parseCasePathology);
}

/** The picture that was taken in a tick of a stored attempt, or the live one of it. */
export async function fetchReplayPicture(id: number, tick: number): Promise<CArmPicture> {
  const answer = await get(`/api/attempts/${id}/replay/picture?at=${tick}`);
  const picture = parseCArmPicture(await answer.arrayBuffer());
  if (!picture.ok) throw new HostUnreachable(picture.reason);
  return picture.value;
}

export function fetchPictureTruth(id: number, tick: number): Promise<PictureTruth> {
  return ask(`/api/attempts/${id}/replay/truth?at=${tick}`, parsePictureTruth);
}

/** What an arthroscopy truly saw of the joints' cartilage. */
export function fetchSeenCartilage(id: number): Promise<SeenCartilage> {
  return ask(`/api/attempts/${id}/replay/cartilage`, parseSeenCartilage);
}

export function fetchViewDebrief(id: number): Promise<ViewDebrief> {
  return ask(`/api/attempts/${id}/replay/views`, parseViewDebrief);
}

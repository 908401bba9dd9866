// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Questions about a stored attempt's course: what the host said then, checked as then.
import { parseHostMessage, type ExerciseMessage, type HostMessage } from "../protocol";
import { statesOf, type ReplayState, type Stretch } from "./replay_buffer_model";

async function ask(path: string, signal?: AbortSignal): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(path, signal === undefined ? {} : { signal });
  } catch (error) {
    if (signal?.aborted === true) throw error;
    throw new Error("The host does not answer. Is `carpus serve` running?");
  }
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return answer;
}

function message(line: string): HostMessage {
  const parsed = parseHostMessage(line);
  if (!parsed.ok) throw new Error(`The replay cannot be read: ${parsed.reason}`);
  return parsed.value;
}

export async function fetchExercise(attempt: number): Promise<ExerciseMessage> {
  const answer = await ask(`/api/attempts/${attempt}/replay/exercise`);
  const exercise = message(await answer.text());
  if (exercise.type !== "exercise") throw new Error("The replay cannot be read.");
  return exercise;
}

export async function fetchStates(
  attempt: number,
  { from, to, every }: Stretch,
  signal: AbortSignal,
): Promise<ReplayState[]> {
  const query = `from=${from}&to=${to}&every=${every}`;
  const answer = await ask(`/api/attempts/${attempt}/replay/states?${query}`, signal);
  const lines = (await answer.text()).split("\n").filter((line) => line !== "");
  return statesOf(lines.map(message));
}

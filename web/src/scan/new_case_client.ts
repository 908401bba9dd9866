// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A new case on the host: files are brought one after another, then the host makes a case of them and
// tells how far it is. Nothing of it goes anywhere else.
import { parseMended, type MendedBone } from "./mended_model";
import { parseState, type SeriesOffer } from "./new_case_model";

const ADDRESS = "/api/new_case";
const LOOK_EVERY_MS = 400;
/** Of what takes a second or two. */
const LOOK_OFTEN_MS = 50;
/** The host throws away what nobody asks after for half a minute. */
const KEEP_EVERY_MS = 5_000;

/** Told while it goes on. @param part  0 to 1 */
export type Told = (what: string, part: number) => void;

export interface BroughtFile {
  /** "dcm", "nii.gz": what the host is told of it; its name stays here. */
  readonly as: string;
  readonly content: Blob;
}

async function ask(method: string, address: string, signal?: AbortSignal): Promise<string> {
  let answer: Response;
  try {
    answer = await fetch(address, { method, ...(signal === undefined ? {} : { signal }) });
  } catch (error) {
    if (signal?.aborted === true) throw error;
    throw new Error("The host does not answer. Is `carpus serve` running?");
  }
  const text = await answer.text();
  // The host says why, for people.
  if (!answer.ok) throw new Error(text.trim());
  return text;
}

/** With progress within a file, which fetch does not tell. */
function put(
  address: string,
  content: Blob,
  told: (bytes: number) => void,
  signal: AbortSignal,
): Promise<void> {
  return new Promise((done, fail) => {
    const request = new XMLHttpRequest();
    const stop = (): void => {
      request.abort();
    };
    request.open("PUT", address);
    request.upload.addEventListener("progress", (event) => {
      told(event.loaded);
    });
    request.addEventListener("loadend", () => {
      signal.removeEventListener("abort", stop);
      if (signal.aborted) fail(new DOMException("given up", "AbortError"));
      else if (request.status === 200) done();
      else if (request.status === 0) fail(new Error("The host took no more of it."));
      else fail(new Error(request.responseText.trim()));
    });
    signal.addEventListener("abort", stop);
    request.send(content);
  });
}

/** Whether who looks at this page may add cases; the host refuses the others in any case. */
export async function mayAddCases(): Promise<boolean> {
  try {
    const told = JSON.parse(await ask("GET", ADDRESS)) as Readonly<Record<string, unknown>>;
    return told["may_add"] === true;
  } catch {
    return false;
  }
}

export interface NewCaseWish {
  /** In order; each is fetched when its turn has come. */
  readonly files: AsyncIterable<BroughtFile>;
  /** Of all files together, for the progress. */
  readonly bytes: number;
  readonly title: string;
  /** Of the case whose labels they are; undefined for a scan. */
  readonly of?: string;
  /** Asks a person which of several series is the scan. @return its place in the list */
  choose(series: readonly SeriesOffer[], signal: AbortSignal): Promise<number>;
}

/** People take their time. */
async function whileAsked<T>(address: string, answer: Promise<T>): Promise<T> {
  const timer = setInterval(() => {
    ask("GET", address).catch(() => undefined);
  }, KEEP_EVERY_MS);
  try {
    return await answer;
  } finally {
    clearInterval(timer);
  }
}

/** @return the id of the new case */
export async function makeNewCase(
  wish: NewCaseWish,
  told: Told,
  signal: AbortSignal,
): Promise<string> {
  const begun = JSON.parse(await ask("POST", ADDRESS, signal)) as { readonly word: string };
  const word = `word=${encodeURIComponent(begun.word)}`;
  try {
    let before = 0;
    for await (const { as, content } of wish.files) {
      signal.throwIfAborted();
      const tell = (bytes: number): void => {
        const part = Math.min(1, (before + bytes) / Math.max(1, wish.bytes));
        told("bringing it to the host", part);
      };
      await put(`${ADDRESS}/file?${word}&as=${as}`, content, tell, signal);
      before += content.size;
    }
    const of = wish.of === undefined ? "" : `&of=${encodeURIComponent(wish.of)}`;
    const title = wish.title === "" ? "" : `&title=${encodeURIComponent(wish.title)}`;
    await ask("POST", `${ADDRESS}/run?${word}${title}${of}`, signal);
    for (;;) {
      const now = parseState(await ask("GET", `${ADDRESS}?${word}`, signal));
      if (now.state === "done" && now.problem === "") return now.id;
      if (now.state === "done") throw new Error(now.problem);
      if (now.state === "choosing") {
        const which = await whileAsked(`${ADDRESS}?${word}`, wish.choose(now.series, signal));
        await ask("POST", `${ADDRESS}/run?${word}&series=${which}`, signal);
        continue;
      }
      told(now.doing, now.fraction);
      await new Promise((wake) => setTimeout(wake, LOOK_EVERY_MS));
      signal.throwIfAborted();
    }
  } catch (error) {
    await ask("DELETE", `${ADDRESS}?${word}`).catch(() => undefined);
    throw error;
  }
}

export interface MendWish {
  /** The case whose labels they are. */
  readonly of: string;
  /** As they are now, packed. */
  readonly labels: Blob;
  /** And before what was painted; undefined for those of the case. */
  readonly before: Blob | undefined;
  /** What was painted is a marker: the host lets the water in. */
  readonly grows: boolean;
}

export interface MendedLook {
  readonly bones: readonly MendedBone[];
  /** Surfaces, of those bones that have voxels. */
  readonly glb: ArrayBuffer | undefined;
  /** The labels after the water, packed; only where it was let in. */
  readonly labels: Blob | undefined;
}

/** Only the bones that were painted, made anew by the host; no case is changed or made. */
export async function lookAtMended(wish: MendWish, signal: AbortSignal): Promise<MendedLook> {
  const begun = JSON.parse(await ask("POST", ADDRESS, signal)) as { readonly word: string };
  const word = `word=${encodeURIComponent(begun.word)}`;
  const made = async (file: string): Promise<Response> => {
    const answer = await fetch(`${ADDRESS}/made?${word}&file=${file}`, { signal });
    if (!answer.ok) throw new Error((await answer.text()).trim());
    return answer;
  };
  try {
    for (const content of [wish.labels, ...(wish.before === undefined ? [] : [wish.before])]) {
      await put(`${ADDRESS}/file?${word}&as=nii.gz`, content, () => undefined, signal);
    }
    const of = `&of=${encodeURIComponent(wish.of)}&look=1${wish.grows ? "&grow=1" : ""}`;
    await ask("POST", `${ADDRESS}/run?${word}${of}`, signal);
    for (;;) {
      const now = parseState(await ask("GET", `${ADDRESS}?${word}`, signal));
      if (now.state === "done" && now.problem !== "") throw new Error(now.problem);
      if (now.state === "done") break;
      await new Promise((wake) => setTimeout(wake, LOOK_OFTEN_MS));
      signal.throwIfAborted();
    }
    const bones = parseMended(await (await made("mended.json")).text());
    const isThere = bones.some((bone) => bone.volumeMm3 > 0);
    return {
      bones,
      glb: isThere ? await (await made("bones.glb")).arrayBuffer() : undefined,
      labels: wish.grows ? await (await made("labels.nii.gz")).blob() : undefined,
    };
  } finally {
    await ask("DELETE", `${ADDRESS}?${word}`).catch(() => undefined);
  }
}

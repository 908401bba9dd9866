// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A new case on the host: files are brought one after another, then the host makes a case of them and
// tells how far it is. Nothing of it goes anywhere else.

const ADDRESS = "/api/new_case";
const LOOK_EVERY_MS = 400;

/** Told while it goes on. @param part  0 to 1 */
export type Told = (what: string, part: number) => void;

export interface BroughtFile {
  /** "dcm", "nii.gz": what the host is told of it; its name stays here. */
  readonly as: string;
  readonly content: Blob;
}

interface NewCaseState {
  readonly state: string;
  readonly doing: string;
  readonly fraction: number;
  readonly id: string;
  readonly problem: string;
}

function parseState(text: string): NewCaseState {
  const json = JSON.parse(text) as Readonly<Record<string, unknown>>;
  const word = (name: string): string => {
    const value = json[name];
    return typeof value === "string" ? value : "";
  };
  const fraction = json["fraction"];
  return {
    state: word("state"),
    doing: word("doing"),
    fraction: typeof fraction === "number" ? Math.min(1, Math.max(0, fraction)) : 0,
    id: word("id"),
    problem: word("problem"),
  };
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

export interface NewCaseWish {
  /** In order; each is fetched when its turn has come. */
  readonly files: AsyncIterable<BroughtFile>;
  /** Of all files together, for the progress. */
  readonly bytes: number;
  readonly title: string;
  /** Of the case whose labels they are; undefined for a scan. */
  readonly of?: string;
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
      told(now.doing, now.fraction);
      await new Promise((wake) => setTimeout(wake, LOOK_EVERY_MS));
      signal.throwIfAborted();
    }
  } catch (error) {
    await ask("DELETE", `${ADDRESS}?${word}`).catch(() => undefined);
    throw error;
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The way of a new case, against a host that answers as server/new_case_desk.hpp says.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { makeNewCase, mayAddCases, type BroughtFile, type NewCaseWish } from "./new_case_client";

/** What the host was asked, in order, and the states it tells one after the other. */
let asked: string[] = [];
let states: object[] = [];
let uploaded: (() => void) | undefined;

class HostsUpload extends EventTarget {
  readonly upload = new EventTarget();
  status = 0;
  responseText = "";
  private line = "";
  open(method: string, address: string): void {
    this.line = `${method} ${address}`;
  }
  send(content: Blob): void {
    asked.push(this.line);
    for (const part of [0.5, 1]) {
      const told = Object.assign(new Event("progress"), { loaded: part * content.size });
      this.upload.dispatchEvent(told);
    }
    uploaded?.();
    if (uploaded === undefined) this.end(200);
  }
  abort(): void {
    this.end(0);
  }
  private end(status: number): void {
    this.status = status;
    this.dispatchEvent(new Event("loadend"));
  }
}

function answer(address: string, init: RequestInit): Response {
  const line = `${init.method ?? "GET"} ${address}`;
  asked.push(line);
  if (line === "POST /api/new_case") return Response.json({ word: "w 1" });
  if (line === "GET /api/new_case") return Response.json({ may_add: true });
  if (line.startsWith("GET ")) return Response.json(states.shift() ?? { state: "working" });
  return Response.json({});
}

async function* two(): AsyncGenerator<BroughtFile> {
  await Promise.resolve();
  yield { as: "dcm", content: new Blob(["0123456789"]) };
  yield { as: "dcm", content: new Blob(["0123456789"]) };
}

function wish(more: Partial<NewCaseWish> = {}): NewCaseWish {
  const choose = (): Promise<number> => Promise.reject(new Error("nobody is asked"));
  return { files: two(), bytes: 20, title: "A wrist & more", choose, ...more };
}

beforeEach(() => {
  asked = [];
  states = [];
  uploaded = undefined;
  vi.stubGlobal("XMLHttpRequest", HostsUpload);
  vi.stubGlobal("fetch", (address: string, init: RequestInit = {}) =>
    init.signal?.aborted === true
      ? Promise.reject(new DOMException("", "AbortError"))
      : Promise.resolve(answer(address, init)),
  );
});
afterEach(() => vi.unstubAllGlobals());

describe("a new case", () => {
  it("is brought file by file, made, and told of as a part of the whole", async () => {
    states = [
      { state: "working", doing: "surfaces", fraction: 7 },
      { state: "done", id: "scan-2" },
    ];
    const told: [string, number][] = [];
    const id = await makeNewCase(
      wish(),
      (what, part) => told.push([what, part]),
      new AbortController().signal,
    );
    expect(id).toBe("scan-2");
    expect(asked).toEqual([
      "POST /api/new_case",
      "PUT /api/new_case/file?word=w%201&as=dcm",
      "PUT /api/new_case/file?word=w%201&as=dcm",
      "POST /api/new_case/run?word=w%201&title=A%20wrist%20%26%20more",
      "GET /api/new_case?word=w%201",
      "GET /api/new_case?word=w%201",
    ]);
    expect(told.map(([, part]) => part)).toEqual([0.25, 0.5, 0.75, 1, 1]);
    expect(told.at(-1)).toEqual(["surfaces", 1]);
  });

  it("asks a person which of several series it is", async () => {
    const series = [
      { description: "Bone", slices: 200, spacing_mm: [0.3, 0.3, 0.5] },
      { description: "", slices: 90, spacing_mm: [] },
    ];
    states = [
      { state: "choosing", series },
      { state: "done", id: "scan-2" },
    ];
    const offered: number[] = [];
    const choose: NewCaseWish["choose"] = (list) => {
      offered.push(...list.map((one) => one.slices));
      return Promise.resolve(1);
    };
    await makeNewCase(wish({ choose }), () => undefined, new AbortController().signal);
    expect(offered).toEqual([200, 90]);
    expect(asked).toContain("POST /api/new_case/run?word=w%201&series=1");
  });

  it("is given up on the host when a person gives it up while it is brought", async () => {
    const abort = new AbortController();
    uploaded = () => {
      abort.abort();
    };
    await expect(makeNewCase(wish(), () => undefined, abort.signal)).rejects.toThrow("given up");
    expect(asked.slice(1)).toEqual([
      "PUT /api/new_case/file?word=w%201&as=dcm",
      "DELETE /api/new_case?word=w%201",
    ]);
  });

  it("says why there is none, in the host's words, and leaves nothing there", async () => {
    states = [{ state: "done", problem: "no bone found" }];
    await expect(
      makeNewCase(wish(), () => undefined, new AbortController().signal),
    ).rejects.toThrow("no bone found");
    expect(asked.at(-1)).toBe("DELETE /api/new_case?word=w%201");
  });

  it("is offered to those alone whom the host would let", async () => {
    expect(await mayAddCases()).toBe(true);
    vi.stubGlobal("fetch", () => Promise.resolve(new Response("no", { status: 403 })));
    expect(await mayAddCases()).toBe(false);
  });
});

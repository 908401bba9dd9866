// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { newDraft, type Draft } from "./draft_model";

const FIRST = { id: 1, started_at: "2026-11-02T10:00:00Z" };
const draft: Draft = {
  rater: "Dr A",
  comment: "Look round first.",
  chosen: new Map([["safety", 4]]),
  basis: { rater: "Dr A", revision: 2 },
  isChanged: true,
};

/** As a page that was loaded anew has it: what is not in the storage is gone. */
async function loadAnew(): Promise<typeof import("./kept_drafts")> {
  vi.resetModules();
  return import("./kept_drafts");
}

describe("a draft that was not saved", () => {
  const stored = new Map<string, string>();
  beforeEach(() => {
    vi.stubGlobal("sessionStorage", {
      getItem: (key: string) => stored.get(key) ?? null,
      setItem: (key: string, text: string) => stored.set(key, text),
      removeItem: (key: string) => stored.delete(key),
    });
  });
  afterEach(() => {
    stored.clear();
    vi.unstubAllGlobals();
  });

  it("is there when the page is loaded anew, nameless too", async () => {
    (await loadAnew()).keepDraft(FIRST, draft);
    expect((await loadAnew()).keptDraft(FIRST)).toEqual(draft);
    const nameless = { ...newDraft(""), chosen: draft.chosen, isChanged: true };
    (await loadAnew()).keepDraft(FIRST, nameless);
    expect((await loadAnew()).keptDraft(FIRST)).toEqual(nameless);
  });
  it("is of its attempt alone, not of one of the same number in other records", async () => {
    (await loadAnew()).keepDraft(FIRST, draft);
    const { keptDraft } = await loadAnew();
    expect(keptDraft({ ...FIRST, id: 2 })).toBeUndefined();
    expect(keptDraft({ ...FIRST, started_at: "2026-11-03T10:00:00Z" })).toBeUndefined();
  });
  it("is gone once it is saved", async () => {
    const { forgetDraft, keepDraft, keptDraft } = await loadAnew();
    keepDraft(FIRST, draft);
    forgetDraft(FIRST);
    expect(keptDraft(FIRST)).toBeUndefined();
    expect(stored.size).toBe(0);
  });
  it("that cannot be read is none", async () => {
    (await loadAnew()).keepDraft(FIRST, draft);
    for (const key of stored.keys()) stored.set(key, '{"rater":7}');
    expect((await loadAnew()).keptDraft(FIRST)).toBeUndefined();
  });
  it("lasts as long as the page where nothing may be stored", async () => {
    const refuse = (): never => {
      throw new Error("forbidden");
    };
    vi.stubGlobal("sessionStorage", { getItem: refuse, setItem: refuse, removeItem: refuse });
    const { forgetDraft, keepDraft, keptDraft } = await loadAnew();
    keepDraft(FIRST, draft);
    expect(keptDraft(FIRST)).toEqual(draft);
    forgetDraft(FIRST);
    expect(keptDraft(FIRST)).toBeUndefined();
  });
});

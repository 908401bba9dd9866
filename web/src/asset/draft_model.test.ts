// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { AssetForm } from "../protocol";
import { draftOf, firstDraft, newDraft, ratingOf, unseenForm } from "./draft_model";

const form = (rater: string, revision: number): AssetForm => ({
  rater,
  revision,
  saved_at: "2026-11-02T10:00:00Z",
  answers: [{ domain: "safety", points: 4 }],
  comment: "Well.",
  total: null,
  passes: null,
});

describe("a draft", () => {
  it("begins with the rater's own form, or anew", () => {
    const forms = [form("Dr A", 2), form("Dr B", 1)];
    expect(ratingOf(firstDraft("Dr A", forms))).toEqual({
      rater: "Dr A",
      revision: 2,
      answers: [{ domain: "safety", points: 4 }],
      comment: "Well.",
    });
    expect(ratingOf(firstDraft("Dr C", forms))).toMatchObject({ revision: 0, answers: [] });
  });
  it("under another name amends nothing", () => {
    const draft = { ...draftOf(form("Dr A", 2)), rater: " Dr B " };
    expect(ratingOf(draft)).toMatchObject({ rater: "Dr B", revision: 0 });
  });
  it("tells of a form of its name that it did not begin from", () => {
    const forms = [form("Dr A", 2)];
    expect(unseenForm(newDraft("Dr A "), forms)?.revision).toBe(2);
    expect(unseenForm(draftOf(form("Dr A", 1)), forms)?.revision).toBe(2);
    expect(unseenForm(draftOf(form("Dr A", 2)), forms)).toBeUndefined();
    expect(unseenForm(newDraft("Dr B"), forms)).toBeUndefined();
    expect(unseenForm({ ...draftOf(form("Dr A", 2)), rater: "Dr B" }, forms)).toBeUndefined();
  });
});

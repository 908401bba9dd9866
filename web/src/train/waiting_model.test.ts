// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who comes to a waiting operation learns whose it is before going on with it.
import { describe, expect, it } from "vitest";
import type { Step } from "../protocol";
import { lostText, waitingText } from "./waiting_model";

const NOW = new Date(2026, 4, 3, 15, 0);
const STEPS: readonly Step[] = ["Survey", "Drive the wire"].map((title) => ({
  id: title,
  title,
  instruction: "",
  actions: [],
  instrument: "",
}));
const STARTED = new Date(2026, 4, 3, 14, 7);

describe("waitingText", () => {
  it("says whose, since when and how far", () => {
    const text = waitingText(
      { trainee: "Ada", startedAt: STARTED.toISOString(), isOwn: true },
      { step: 1, tick: 125_400 },
      STEPS,
      NOW,
    );
    expect(text).toBe(
      "The operation of Ada waits, begun at 14:07; 2 min 5 s in, at step 2, Drive the wire. " +
        "Going on keeps it under that name.",
    );
  });

  it("says the day where it is another, and no name where none was typed", () => {
    const text = waitingText(
      { trainee: "", startedAt: STARTED.toISOString(), isOwn: true },
      { step: 0, tick: 9_900 },
      STEPS,
      new Date(2026, 4, 4, 8, 0),
    );
    expect(text).toMatch(
      /^An operation without a name waits, begun at 14:07 on 2026-05-03; 9 s in/,
    );
  });

  it("says what it knows before the first state and without a time", () => {
    expect(waitingText({ trainee: "Ada", startedAt: "", isOwn: true }, undefined, [], NOW)).toBe(
      "The operation of Ada waits. Going on keeps it under that name.",
    );
  });

  it("says of another's that it is not this page's to go on with", () => {
    const foreign = { trainee: "", startedAt: STARTED.toISOString(), isOwn: false };
    expect(waitingText(foreign, undefined, [], NOW)).toBe(
      "Another page's operation waits, begun at 14:07. " +
        "Only its own page goes on with it; starting anew stores it as unfinished.",
    );
    expect(waitingText({ ...foreign, trainee: "Ada" }, undefined, [], NOW)).toMatch(
      /^The operation of Ada waits, .*Only its own page/,
    );
  });
});

describe("what is lost", () => {
  it("is said only where something is", () => {
    expect(lostText(12_345, 11_945)).toBe(
      "The station was started again: the last 0.4 s are lost, the rest goes on.",
    );
    expect(lostText(12_345, 12_345)).toBe("");
    expect(lostText(undefined, 5)).toBe("");
  });
});

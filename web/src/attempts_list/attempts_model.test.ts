// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The list shows every readable attempt, in the host's order.
import { describe, expect, it } from "vitest";
import { dateText, durationText, parseAttempt, parseAttempts } from "./attempts_model";

describe("parseAttempts", () => {
  it("keeps the order and the figures, and passes over what is none", () => {
    const attempts = parseAttempts([
      { id: 2, trainee: "A", outcome: "finished", overall: 71, duration_ticks: 61500 },
      "x",
      { id: 1, trainee: "B", outcome: "unfinished", overall: null },
    ]);
    expect(attempts.map((a) => a.id)).toEqual([2, 1]);
    expect(attempts[0]).toMatchObject({ finished: true, overall: 71, durationS: 61.5 });
    expect(attempts[1]).toMatchObject({ finished: false, overall: undefined });
  });
  it.each([null, 1, {}, { attempts: 1 }])("takes %j as none", (json) => {
    expect(parseAttempts(json)).toEqual([]);
  });
});

describe("parseAttempt", () => {
  it.each([
    [true, true],
    [false, false],
    [null, undefined],
    ["true", undefined],
  ])("takes case_simulated %j as %j", (said, known) => {
    expect(parseAttempt({ id: 1, case_simulated: said })?.caseSimulated).toBe(known);
  });
  it("reads the state hash where the host writes it", () => {
    expect(parseAttempt({ id: 1, state_hash: "0123456789abcdef" })?.stateHash).toBe(
      "0123456789abcdef",
    );
  });
});

describe("texts", () => {
  it("write minutes and leave what is no date", () => {
    expect(durationText(61.5)).toBe("1:02");
    expect(durationText(undefined)).toBe("");
    expect(dateText("soon")).toBe("soon");
    expect(dateText("2026-11-21T03:15:00Z")).toMatch(/2026/);
  });
});

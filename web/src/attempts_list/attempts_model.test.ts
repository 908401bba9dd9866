// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Figures as people write them.
import { describe, expect, it } from "vitest";
import { dateText, durationText, procedureText, shownText } from "./attempts_model";

describe("texts", () => {
  it("write minutes and leave what is no date", () => {
    expect(durationText(61.5)).toBe("1:02");
    const known = [{ id: "a_procedure", title: "A procedure", summary: "" }];
    expect(procedureText("a_procedure", known)).toBe("A procedure");
    expect(procedureText("another", known)).toBe("another");
    expect(shownText(50, 20_000)).toBe("50 of 20\u202f000 attempts");
    expect(shownText(7, 7)).toBe("");
    expect(dateText("soon")).toBe("soon");
    expect(dateText("2026-11-21T03:15:00Z")).toMatch(/2026/);
  });
});

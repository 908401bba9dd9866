// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { titleAmong } from "./case_titles_model";

describe("titles of cases", () => {
  const cases = [
    { id: "a", title: "p1" },
    { id: "b", title: "p1 " },
    { id: "p1", title: "p1" },
    { id: "waist", title: "Waist fracture" },
  ];
  it("are told apart by the folder where they are alike, and are as they are otherwise", () => {
    expect(cases.map((one) => titleAmong(one, cases))).toEqual([
      "p1 (a)",
      "p1  (b)",
      "p1",
      "Waist fracture",
    ]);
  });
  it("are all different", () => {
    const all = new Set(cases.map((one) => titleAmong(one, cases)));
    expect(all.size).toBe(cases.length);
  });
});

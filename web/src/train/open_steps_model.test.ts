// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Nobody ends an operation with open steps without having been told.
import { describe, expect, it } from "vitest";
import { openStepsText } from "./open_steps_model";

const steps = ["Survey", "Entry point", "Aim", "Drive", "Check", "Measure"].map((title) => ({
  title,
}));

describe("openStepsText", () => {
  it("says nothing where all are done", () => {
    expect(openStepsText(steps, [5, 4, 3, 2, 1, 0])).toBe("");
  });

  it("names one, some, and the first of many", () => {
    expect(openStepsText(steps, [0, 1, 2, 3, 4])).toBe("A step is still open: Measure.");
    expect(openStepsText(steps, [0, 1, 3, 4])).toBe("2 of 6 steps are still open: Aim, Measure.");
    expect(openStepsText(steps, [])).toBe(
      "6 of 6 steps are still open: Survey, Entry point, Aim, Drive and 2 more.",
    );
  });
});

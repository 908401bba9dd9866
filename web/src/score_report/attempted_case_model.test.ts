// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Only the case that an attempt was made on lends it bones and badge.
import { describe, expect, it } from "vitest";
import { parseAttempt } from "../attempts_list";
import { attemptedCase } from "./attempted_case_model";

const attempt = { id: 3, case: "demo wrist" };

describe("attemptedCase", () => {
  it("draws where the attempt's case is the open one", () => {
    const here = parseAttempt({ ...attempt, case_is_open: true });
    expect(attemptedCase(here, { simulated: true })).toEqual({ notice: "", simulated: true });
    expect(attemptedCase(here, { simulated: false }).simulated).toBe(false);
  });

  it.each([false, null, "true", undefined])("takes case_is_open %j as another case", (isOpen) => {
    const fields = isOpen === undefined ? attempt : { ...attempt, case_is_open: isOpen };
    expect(attemptedCase(parseAttempt(fields), { simulated: true })).toEqual({
      notice:
        "This attempt was made on another case, demo wrist; open that case to see the placement.",
      simulated: false,
    });
  });

  it("believes what was noted with the attempt before what the open case says", () => {
    const noted = { ...attempt, case_simulated: true };
    expect(attemptedCase(parseAttempt(noted), { simulated: false }).simulated).toBe(true);
    const scanned = { ...attempt, case_simulated: false, case_is_open: true };
    expect(attemptedCase(parseAttempt(scanned), { simulated: true }).simulated).toBe(false);
  });

  it("leaves out a name that is not known", () => {
    expect(attemptedCase(undefined, { simulated: true }).notice).toBe(
      "This attempt was made on another case; open that case to see the placement.",
    );
  });
});

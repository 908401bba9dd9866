// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Only the case that an attempt was made on lends it bones and badge.
import { describe, expect, it } from "vitest";
import { wantedCase } from "../case_data";
import { attemptedCase } from "./attempted_case_model";

const attempt = {
  id: 12,
  case: "demo wrist",
  case_here: "",
  case_is_open: false,
  case_simulated: null,
};

describe("attemptedCase", () => {
  it("draws where the attempt's case is the open one", () => {
    const here = { ...attempt, case_is_open: true };
    expect(attemptedCase(here, { simulated: true })).toEqual({
      notice: "",
      way: "",
      simulated: true,
    });
    expect(attemptedCase(here, { simulated: false }).simulated).toBe(false);
  });

  it("names another case and does not lend it the open one's badge", () => {
    expect(attemptedCase(attempt, { simulated: true })).toEqual({
      notice:
        "This attempt was made on another case, demo wrist; open that case to see the placement.",
      way: "",
      simulated: false,
    });
  });

  it("leads to a case that is here, and back to the report", () => {
    const { way } = attemptedCase({ ...attempt, case_here: "easy" }, { simulated: true });
    expect(wantedCase(way)).toEqual({ id: "easy", then: "#/attempts/12" });
  });

  it("believes what was noted with the attempt before what the open case says", () => {
    const noted = { ...attempt, case_simulated: true };
    expect(attemptedCase(noted, { simulated: false }).simulated).toBe(true);
    const scanned = { ...attempt, case_simulated: false, case_is_open: true };
    expect(attemptedCase(scanned, { simulated: true }).simulated).toBe(false);
  });

  it("leaves out a name that is not known", () => {
    expect(attemptedCase({ ...attempt, case: "" }, { simulated: true }).notice).toBe(
      "This attempt was made on another case; open that case to see the placement.",
    );
  });
});

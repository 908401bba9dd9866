// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { addressOfCase, wantedCase } from "./wanted_case_model";

describe("the case that an address wants", () => {
  it("is what was put into it", () => {
    const address = addressOfCase("displaced left & deep", "replay/12");
    expect(wantedCase(address)).toEqual({ id: "displaced left & deep", then: "#/replay/12" });
  });

  it("goes on to an attempt's pages and nowhere else", () => {
    expect(wantedCase("#/?case=easy&then=attempts/3")?.then).toBe("#/attempts/3");
    expect(wantedCase("#/?case=easy&then=scan")?.then).toBe("");
    expect(wantedCase("#/?case=easy")?.then).toBe("");
  });

  it("is none where the address names none", () => {
    for (const hash of ["", "#/", "#/?", "#/?case=", "#/replay/12", "#/scan/easy"]) {
      expect(wantedCase(hash)).toBeUndefined();
    }
  });
});

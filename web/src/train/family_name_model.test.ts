// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whole words only: "1" of "12" and "14" is no part of a name.
import { describe, expect, it } from "vitest";
import { commonBeginning } from "./family_name_model";

describe("commonBeginning", () => {
  it("ends before the words that differ", () => {
    expect(commonBeginning(["Screw A 12 mm", "Screw A 14 mm"])).toBe("Screw A");
    expect(commonBeginning(["Screw A 12 mm", "Other 12 mm"])).toBe("");
  });

  it("is the whole of a single name", () => {
    expect(commonBeginning(["Screw A 12 mm"])).toBe("Screw A 12 mm");
    expect(commonBeginning([])).toBe("");
  });
});

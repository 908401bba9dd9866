// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { DoseByView, dosesText } from "./dose_by_view_model";

describe("DoseByView", () => {
  it("gives what the dose grew by to the view of that moment", () => {
    const doses = new DoseByView();
    doses.see(0, "PA");
    doses.see(0.5, "PA");
    doses.see(0.5, "LAT");
    doses.see(0.75, "LAT");
    doses.see(1.25, "PA");
    expect(dosesText(doses.list)).toBe("PA 1.0, LAT 0.3");
  });

  it("forgets with the exercise", () => {
    const doses = new DoseByView();
    doses.see(0, "PA");
    doses.see(3, "PA");
    doses.clear();
    doses.see(0, "SKY");
    doses.see(0.5, "SKY");
    expect(dosesText(doses.list)).toBe("SKY 0.5");
  });

  it("gives what there was before the page came back to no view", () => {
    const doses = new DoseByView();
    doses.see(3, "45P");
    doses.see(3.5, "PA");
    expect(dosesText(doses.list)).toBe("earlier 3.0, PA 0.5");
  });
});

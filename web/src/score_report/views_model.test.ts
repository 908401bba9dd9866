// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { FaultSeen, PlacementFault } from "../protocol";
import { faultText, shownText, shownWhen, verdictText, wireText } from "./views_model";

const seen = (view: string, shot: number, overhang_mm: number): FaultSeen => ({
  view,
  label: view.toUpperCase(),
  tick: shot * 1000,
  shot,
  rotation_deg: 0,
  tilt_deg: 0,
  overhang_mm,
  reveals: overhang_mm >= 0.5,
});
const fault = (...all: FaultSeen[]): PlacementFault => ({
  kind: "screw_out",
  place: "distal",
  depth_mm: 1.24,
  towards: "trapezium",
  seen: all,
});

describe("what a view shows of a fault", () => {
  it("is told with the place and the best view", () => {
    const one = fault(seen("pa", 0, 0.1), seen("45p", 0, 1.1), seen("", 4, -1), seen("", 5, 0.2));
    expect(faultText(one)).toBe(
      "The rim of the screw is 1.2 mm out at its distal end, towards the trapezium.",
    );
    expect(verdictText(one)).toBe(
      "None of the 2 pictures taken of it showed it. 45P shows it best: 1.1 mm beyond the bone.",
    );
  });
  it("tells which picture showed it, and that none was taken", () => {
    expect(verdictText(fault(seen("pa", 0, 0.1), seen("", 4, 0.8)))).toBe(
      "Shot 4 showed it. None of the preset views shows it enough.",
    );
    expect(verdictText(fault(seen("pa", 0, 0.7)))).toBe(
      "No picture was taken of it as it lies. PA shows it best: 0.7 mm beyond the bone.",
    );
  });
  it("is called hidden or too little where it is", () => {
    expect(shownText("screw_out", seen("pa", 0, -0.3))).toBe("hidden by the bone");
    expect(shownText("screw_out", seen("pa", 0, 0.3))).toBe(
      "0.3 mm beyond the bone: too little to see",
    );
    expect(shownText("screw_out", seen("pa", 0, 0.9))).toBe("0.9 mm beyond the bone");
  });
  it("is told of pieces that do not meet", () => {
    const step = { ...fault(seen("pa", 0, 1.8)), kind: "step" as const, depth_mm: 1.9 };
    expect(faultText(step)).toBe("The fracture has a step of 1.9 mm.");
    expect(verdictText(step)).toContain("PA shows it best: 1.8 mm between their edges.");
    expect(faultText({ ...step, kind: "gap" })).toBe("The pieces lie 1.9 mm apart.");
    expect(shownText("gap", seen("pa", 0, 1.2))).toBe("1.2 mm clear between the pieces");
  });
  it("says of what there is alone when a view shows it", () => {
    const out = fault(seen("pa", 0, 1.8));
    const gap = { ...out, kind: "gap" as const };
    const told = (...faults: PlacementFault[]) =>
      shownWhen({ screw: "a screw", revealed_mm: 0.5, faults }).join(" ");
    expect(told(out)).toBe("A view shows metal that is at least 0.5 mm beyond the bone's outline.");
    expect(told(gap)).not.toContain("metal");
    expect(told(out, gap)).toContain("a step that is at least 0.5 mm high");
  });
  it("speaks of a wire too", () => {
    const truth = { bone: [], screws: [], wires: [], wire_out_mm: 9.03, wire_shown_mm: 6.2 };
    expect(wireText(truth)).toBe(
      "Wire 9.0 mm out of the far side: this picture shows 6.2 mm of it.",
    );
    expect(wireText({ ...truth, wire_shown_mm: -1 })).toContain("hides it");
    expect(wireText({ ...truth, wire_out_mm: null })).toBe("");
  });
});

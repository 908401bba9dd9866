// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { NamedView, WristPose } from "../protocol";
import { ViewWait } from "./view_wait";

const view: NamedView = {
  id: "pa_ulnar",
  label: "PA ulnar",
  rotation_deg: 0,
  tilt_deg: 0,
  flexion_deg: null,
  radial_deviation_deg: -20,
};
const held = (radial_deviation_deg: number): WristPose => ({
  flexion_deg: 44,
  radial_deviation_deg,
  pronation_deg: 0,
  traction_n: 0,
});

describe("ViewWait", () => {
  it("waits while the hand moves, until it is held so", () => {
    const wait = new ViewWait(view, 0);
    expect(wait.see(held(0), 100)).toBe("waits");
    expect(wait.see(held(-10), 5000)).toBe("waits");
    expect(wait.see(held(-19), 5100)).toBe("held");
  });
  it("gives up where the hand has stopped before", () => {
    const wait = new ViewWait(view, 0);
    expect(wait.see(held(-12), 100)).toBe("waits");
    expect(wait.see(held(-12), 1500)).toBe("waits");
    expect(wait.see(held(-12), 1700)).toBe("given_up");
  });
  it("is wanted of views alone that say how the hand is held", () => {
    expect(ViewWait.isWanted(view)).toBe(true);
    expect(ViewWait.isWanted({ ...view, radial_deviation_deg: null })).toBe(false);
  });
});

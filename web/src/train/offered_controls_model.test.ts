// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { offeredControls } from "./offered_controls_model";

const scope = { drive: "none", is_gauge: false };

describe("controls that are offered", () => {
  it("are none of a driver's where nothing on the tray is driven", () => {
    const bare = {
      instruments: [scope],
      views: [],
      ideal: null,
      arthroscopy: {},
      decline_reasons: [],
    } as const;
    expect(offeredControls({ ...bare, mode: "practice" })).toEqual({
      drive: false,
      cArm: false,
      plan: false,
      gauge: false,
      decline: false,
      headset: false,
    });
  });
  it("show the plan in practice alone", () => {
    const fixing = {
      instruments: [{ drive: "powered", is_gauge: false }],
      views: [],
      ideal: {},
      arthroscopy: null,
      decline_reasons: [],
    } as const;
    expect(offeredControls({ ...fixing, mode: "practice" }).plan).toBe(true);
    expect(offeredControls({ ...fixing, mode: "assessed" }).plan).toBe(false);
    expect(offeredControls({ ...fixing, mode: "practice" }).drive).toBe(true);
    expect(offeredControls({ ...fixing, mode: "assessed" }).headset).toBe(true);
  });
});

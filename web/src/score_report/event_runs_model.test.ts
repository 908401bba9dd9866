// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { runsOf } from "./event_runs_model";

const event = (tick: number, text: string) => ({ tick, kind: "touched_bone", text });

describe("runsOf", () => {
  it("counts what follows itself, from when it began", () => {
    const events = [
      event(5, "Touches"),
      event(9, "Touches"),
      event(12, "Slips"),
      event(20, "Touches"),
    ];
    expect(runsOf(events)).toEqual([
      { tick: 5, text: "Touches", times: 2 },
      { tick: 12, text: "Slips", times: 1 },
      { tick: 20, text: "Touches", times: 1 },
    ]);
  });

  it("has nothing to say of nothing", () => {
    expect(runsOf([])).toEqual([]);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Events come in their order; what is none costs nothing but itself.
import { describe, expect, it } from "vitest";
import { parseEvents } from "./events_model";

describe("parseEvents", () => {
  it("reads events in their order", () => {
    const events = [
      { tick: 10, kind: "touched", text: "Touched the scaphoid" },
      { tick: 20, kind: "shot", text: "Picture 1" },
    ];
    expect(parseEvents({ events })).toEqual([
      { tickMs: 10, text: "Touched the scaphoid" },
      { tickMs: 20, text: "Picture 1" },
    ]);
  });

  it("passes over what is no event", () => {
    const events = [
      null,
      7,
      [],
      { tick: "1", text: "x" },
      { tick: -1, text: "x" },
      { tick: 5, text: "" },
    ];
    expect(parseEvents({ events })).toEqual([]);
    for (const attempt of [null, [], "x", {}, { events: "x" }])
      expect(parseEvents(attempt)).toEqual([]);
  });
});

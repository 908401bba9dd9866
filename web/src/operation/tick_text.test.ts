// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// No time reads as sixty seconds.
import { describe, expect, it } from "vitest";
import { tickText } from "./tick_text";

describe("tickText", () => {
  it.each([
    [0, "0:00.0"],
    [1234, "0:01.2"],
    [59_960, "1:00.0"],
    [62_500, "1:02.5"],
    [725_000, "12:05.0"],
  ])("%d ms is %s", (tick, text) => {
    expect(tickText(tick)).toBe(text);
  });
});

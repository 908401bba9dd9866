// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { HandsToSend } from "./hands_to_send";

const LED = { isLed: true, runs: false };
const OTHER = { isLed: false, runs: false };

describe("what the host is told of two hands", () => {
  it("is each hand's change at once, whoever leads it", () => {
    const sending = new HandsToSend();
    for (const hand of [0, 1] as const) {
      sending.mark(hand);
      sending.sent(hand, 1000);
    }
    expect([sending.isDue(0, LED, 1001), sending.isDue(1, OTHER, 1001)]).toEqual([false, false]);
    sending.mark(1);
    expect([sending.isDue(0, LED, 1001), sending.isDue(1, OTHER, 1001)]).toEqual([false, true]);
    sending.mark(0);
    expect([sending.isDue(0, LED, 1001), sending.isDue(1, OTHER, 1001)]).toEqual([true, true]);
  });

  it("is the led hand also while it rests, the other not", () => {
    const sending = new HandsToSend();
    for (const hand of [0, 1] as const) sending.sent(hand, 1000);
    expect(sending.isDue(0, LED, 1199)).toBe(false);
    expect(sending.isDue(0, LED, 1200)).toBe(true);
    expect(sending.isDue(1, OTHER, 1e9)).toBe(false);
  });

  it("is a pedal of either hand before the host lets it go, 150 ms", () => {
    const sending = new HandsToSend();
    sending.sent(1, 1000);
    expect(sending.isDue(1, { ...OTHER, runs: true }, 1040)).toBe(true);
  });

  it("begins with the hand that is led, and with no word of one that nobody moved", () => {
    const sending = new HandsToSend();
    sending.mark(1);
    sending.begin();
    expect([sending.isDue(0, LED, 0), sending.isDue(1, OTHER, 0)]).toEqual([true, false]);
  });
});

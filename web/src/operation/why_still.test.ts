// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { Item, SnapshotMessage } from "../protocol";
import { BY_CONTROLLERS, BY_DEVICE, BY_KEYS, whyItKeepsStill, whyStuck } from "./why_still";

const item = (body: string, wire = -1): Item => ({ item: 0, hand: 0, body, wire }) as Item;
const label = (): string => "scaphoid";

function snapshot(held: Item | undefined, resistanceN = 0): SnapshotMessage {
  const hand = { item: held === undefined ? -1 : 0, resistance_n: resistanceN, touching: false };
  return {
    items: held === undefined ? [] : [held],
    hands: [hand, hand],
  } as unknown as SnapshotMessage;
}

describe("why what is held keeps still", () => {
  it("is that bone holds it, and what brings it out", () => {
    const said = whyItKeepsStill(item("scaphoid"), label, false, BY_KEYS);
    expect(said).toBe(
      "It is held by the scaphoid: hold {KeyR} to bring it out, then place it anew.",
    );
  });

  it("is nothing where it is free, or leads a fragment", () => {
    expect(whyItKeepsStill(item(""), label, false, BY_KEYS)).toBeUndefined();
    expect(whyItKeepsStill(item("scaphoid"), label, true, BY_KEYS)).toBeUndefined();
  });

  it("is more of the bone than the push, which a device gives by being pressed", () => {
    const s = snapshot(item("scaphoid"), 45);
    expect(whyStuck(s, 0, 40, BY_KEYS)).toContain(
      "45 N, you push 40 N: push more, {BracketRight}.",
    );
    expect(whyStuck(s, 0, 40, BY_DEVICE)).toContain("press more.");
    expect(whyStuck(s, 0, 50, BY_KEYS)).toBeUndefined();
  });

  it("names no key to who wears a headset", () => {
    const all = [
      whyItKeepsStill(undefined, label, false, BY_CONTROLLERS),
      whyItKeepsStill(item("scaphoid"), label, false, BY_CONTROLLERS),
      whyItKeepsStill(item("scaphoid", 1), label, false, BY_CONTROLLERS),
      whyStuck(snapshot(undefined), 0, 40, BY_CONTROLLERS),
      whyStuck(snapshot(item("")), 0, 40, BY_CONTROLLERS),
      whyStuck(snapshot(item("scaphoid"), 45), 0, 40, BY_CONTROLLERS),
    ];
    for (const said of all) {
      expect(said).toBeDefined();
      expect(said).not.toMatch(/[{}]|Space|drag/);
    }
  });
});

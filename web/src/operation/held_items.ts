// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the hands hold, of a snapshot.
import type { Item, SnapshotMessage } from "../protocol";

/** A hand of the protocol. */
export type HandIndex = 0 | 1;

export function otherHand(hand: HandIndex): HandIndex {
  return hand === 0 ? 1 : 0;
}

export function heldItem(s: SnapshotMessage, hand: HandIndex): Item | undefined {
  const { item } = s.hands[hand];
  return item < 0 ? undefined : s.items.find((one) => one.item === item);
}

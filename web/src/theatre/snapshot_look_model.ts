// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a new snapshot shows anything that the picture does not: a still hand costs no drawing.
import type { HandState, Item, SnapshotMessage, Vec3 } from "../protocol";

/** Less is not seen: a tenth of a pixel at the closest look [mm], and of a 100 mm shaft [1]. */
const SEEN_MM = 0.002;
const SEEN_TURN = 0.0002;
/** The arrow's length says no less [N]. */
const SEEN_N = 0.05;

function apart(a: Vec3, b: Vec3, seen: number): boolean {
  return (
    Math.abs(a[0] - b[0]) > seen || Math.abs(a[1] - b[1]) > seen || Math.abs(a[2] - b[2]) > seen
  );
}

export function looksDifferent(a: SnapshotMessage, b: SnapshotMessage): boolean {
  if (a.items.length !== b.items.length) return true;
  for (let i = 0; i < b.items.length; ++i) {
    const [before, now] = [a.items[i], b.items[i]];
    if (before === undefined || now === undefined || itemLooksDifferent(before, now)) return true;
  }
  return handLooksDifferent(a.hands[0], b.hands[0]) || handLooksDifferent(a.hands[1], b.hands[1]);
}

function itemLooksDifferent(a: Item, b: Item): boolean {
  return (
    a.item !== b.item ||
    a.instrument !== b.instrument ||
    a.hand !== b.hand ||
    apart(a.tip_mm, b.tip_mm, SEEN_MM) ||
    apart(a.shaft, b.shaft, SEEN_TURN)
  );
}

function handLooksDifferent(a: HandState, b: HandState): boolean {
  if (a.touching !== b.touching || a.item !== b.item) return true;
  return (
    b.touching &&
    (apart(a.force_n, b.force_n, SEEN_N) || apart(a.contact_normal, b.contact_normal, SEEN_TURN))
  );
}

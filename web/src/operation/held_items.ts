// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the hands hold, of a snapshot; and why the page's own ways of moving it do nothing now. Keys are
// named as {KeyA}: key_caps/ says what is printed there.
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

/**
 * @param label  what people call that body
 * @param leads  a fragment of bone goes where a hand takes it by this
 */
export function whyItKeepsStill(
  item: Item | undefined,
  label: (body: string) => string,
  leads: boolean,
): string | undefined {
  if (item === undefined)
    return "This hand is empty: {KeyC} opens the tray, {KeyH} moves the other hand.";
  if (item.body === "" || leads) return undefined;
  const where = `the ${label(item.body)}`;
  return item.wire >= 0
    ? `It runs on its wire in ${where}: hold Space to drive it, {KeyR} to bring it back.`
    : `It is held by ${where}: hold {KeyR} to bring it out, then place it anew.`;
}

/** Said while the driver runs and nothing moves. @param isPressed  a device is pushed with, not keys */
export function whyStuck(
  s: SnapshotMessage,
  hand: HandIndex,
  thrustN: number,
  isPressed: boolean,
): string | undefined {
  const item = heldItem(s, hand);
  if (item === undefined)
    return "This hand is empty: {KeyC} opens the tray, {KeyH} moves the other hand.";
  const { resistance_n, touching } = s.hands[hand];
  if (item.body !== "" && resistance_n > 0 && resistance_n >= thrustN) {
    const more = isPressed ? "press more." : "push more, {BracketRight}.";
    return `The bone resists ${Math.round(resistance_n)} N, you push ${Math.round(thrustN)} N: ${more}`;
  }
  if (item.body === "" && !touching) {
    return "The tip touches no bone: {KeyA} brings it nearer, or drag it onto the bone.";
  }
  return undefined;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Why the page's ways of moving what is held do nothing now, in words; and how what one leads it with is named there.
// Pure.
import type { Item, SnapshotMessage } from "../protocol";
import { heldItem, type HandIndex } from "./held_items";

/** Keys are named as {KeyA}: key_caps/ says what is printed there. */
export interface LedWith {
  readonly drive: string;
  readonly reverse: string;
  readonly pushMore: string;
  readonly nearer: string;
  readonly take: string;
}

export const BY_KEYS: LedWith = {
  drive: "hold Space",
  reverse: "hold {KeyR}",
  pushMore: "push more, {BracketRight}",
  nearer: "{KeyA} brings it nearer, or drag it onto the bone",
  take: "{KeyC} opens the tray, {KeyH} moves the other hand",
};

/** Its force is the push; all else is asked by keys. */
export const BY_DEVICE: LedWith = { ...BY_KEYS, pushMore: "press more" };

/** Of a headset, whose wearer sees no key. */
export const BY_CONTROLLERS: LedWith = {
  drive: "hold the trigger",
  reverse: "hold the grip",
  pushMore: "how much at most is set at the page",
  nearer: "lead it onto the bone",
  take: "the stick chooses, pressed it takes",
};

/**
 * @param label  what people call that body
 * @param leads  a fragment of bone goes where a hand takes it by this
 */
export function whyItKeepsStill(
  item: Item | undefined,
  label: (body: string) => string,
  leads: boolean,
  by: LedWith,
): string | undefined {
  if (item === undefined) return isEmpty(by);
  if (item.body === "" || leads) return undefined;
  const where = `the ${label(item.body)}`;
  return item.wire >= 0
    ? `It runs on its wire in ${where}: ${by.drive} to drive it, ${by.reverse} to bring it back.`
    : `It is held by ${where}: ${by.reverse} to bring it out, then place it anew.`;
}

/** Said while the driver runs and nothing moves. */
export function whyStuck(
  s: SnapshotMessage,
  hand: HandIndex,
  thrustN: number,
  by: LedWith,
): string | undefined {
  const item = heldItem(s, hand);
  if (item === undefined) return isEmpty(by);
  const { resistance_n, touching } = s.hands[hand];
  if (item.body !== "" && resistance_n > 0 && resistance_n >= thrustN) {
    return `The bone resists ${Math.round(resistance_n)} N, you push ${Math.round(thrustN)} N: ${by.pushMore}.`;
  }
  if (item.body === "" && !touching) return `The tip touches no bone: ${by.nearer}.`;
  return undefined;
}

const isEmpty = (by: LedWith): string => `This hand is empty: ${by.take}.`;

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What hands on closed skin feel and do, in words; and why one that is under it keeps still. Keys are named
// as {KeyA}: key_caps/ says what is printed there. Pure.
import type { Instrument, SkinMessage } from "../protocol";

type HandOnSkin = SkinMessage["hands"][number];

/** Deeper a line is held by what it went through [mm]. */
export const HELD_BY_SKIN_MM = 3;

const FELT: Readonly<Record<HandOnSkin["felt"], string>> = {
  nothing: "",
  soft: "soft",
  cord: "tendon, a cord",
  bone: "bone, hard",
};

/** Whether closed skin is worked on with what lies on the tray. */
export function worksOnSkin(instruments: readonly Pick<Instrument, "skin_work">[]): boolean {
  return instruments.some((one) => one.skin_work !== "none");
}

/** One line under the theatre for a hand; empty where there is nothing to say. */
export function skinWords(hand: HandOnSkin | undefined, work: Instrument["skin_work"]): string {
  if (hand === undefined) return "";
  const under = `${hand.under_mm.toFixed(1)} mm`;
  switch (work) {
    case "palpate":
      return FELT[hand.felt];
    case "needle":
      if (hand.is_wet) return `fluid comes back, ${under} in`;
      return hand.under_mm > 0 ? `needle ${under} in` : "";
    case "incise":
      return hand.under_mm > 0 ? `blade ${under} deep` : "";
    case "spread":
      if (hand.is_spreading) return `open, ${under} in`;
      return hand.under_mm > 0 ? `closed, ${under} in` : "";
    case "sheath":
      return hand.under_mm > 0 ? `sheath ${under} in` : "";
    default:
      return "";
  }
}

/** Why it is not swung to another side of the limb; undefined: it is. */
export function whyNotSwung(work: Instrument["skin_work"]): string | undefined {
  if (work === "palpate" || work === "none") return undefined;
  return "On its way round it would go into the skin: lay a fingertip there first, what you take then begins before that place.";
}

/** Why mouse and arrows do not move what is deep under the skin; undefined: they do. */
export function whyHeldBySkin(
  hand: HandOnSkin | undefined,
  work: Instrument["skin_work"],
): string | undefined {
  const isLine = work === "needle" || work === "spread" || work === "sheath";
  if (hand === undefined || !isLine || hand.under_mm <= HELD_BY_SKIN_MM) return undefined;
  return "It is held by what it went through: {KeyA} goes on, {KeyD} draws it back.";
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an arthroscopy goes by, as the host says it. Pure.
import type { ExerciseMessage, Instrument, Item, Vec3 } from "../protocol";

export type Plan = NonNullable<ExerciseMessage["arthroscopy"]>;

export type PlanPortal = Plan["portals"][number];

/** Whether a hand is led at the scope, where portals are made before: it holds what goes in by them; an
 * empty one is where the other is. */
export function isAtScope(
  items: readonly Pick<Item, "hand" | "instrument">[],
  instruments: readonly Pick<Instrument, "id" | "skin_work">[],
  hand: 0 | 1,
): boolean {
  const held =
    items.find((item) => item.hand === hand) ?? items.find((item) => item.hand === 1 - hand);
  return held !== undefined && !makesPortal(held.instrument, instruments);
}

/** Whether what is held makes portals. */
export function makesPortal(
  id: string,
  instruments: readonly Pick<Instrument, "id" | "skin_work">[],
): boolean {
  return instruments.some((one) => one.id === id && one.skin_work !== "none");
}

/** In which the disc lies. */
export const DISC_JOINT = "radiocarpal";

/** Places of the disc that a shaver has taken away. @param left  of the plan's pieces, in percent */
export function cutPlaces(
  plan: Plan,
  left: readonly number[],
): readonly { readonly place: number; readonly outwards: Vec3 }[] {
  return plan.pieces.flatMap(({ kind, inwards }, place) =>
    kind === "disc" && left[place] === 0
      ? [{ place, outwards: [-inwards[0], -inwards[1], -inwards[2]] as const }]
      : [],
  );
}

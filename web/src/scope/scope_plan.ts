// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an arthroscopy goes by, as the host says it. Pure.
import type { ExerciseMessage, Instrument, Item, Vec3 } from "../protocol";

export type Plan = NonNullable<ExerciseMessage["arthroscopy"]>;

export type PlanPortal = Plan["portals"][number];

/** Whether hands are at the scope, where portals are made before: one holds what goes in by them, and none
 * what works on skin. */
export function areAtScope(
  items: readonly Pick<Item, "hand" | "instrument">[],
  instruments: readonly Pick<Instrument, "id" | "skin_work">[],
): boolean {
  const held = items.filter((item) => item.hand >= 0);
  const worksOnSkin = (id: string): boolean =>
    instruments.find((one) => one.id === id)?.skin_work !== "none";
  return held.length > 0 && !held.some((item) => worksOnSkin(item.instrument));
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

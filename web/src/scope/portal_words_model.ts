// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A step's words for the portal that was chosen: {scope:radiocarpal} is the one before which the scope is held, and
// where it lies, {tool:midcarpal} that of what works beside it. Pure.
import type { PlanPortal } from "./scope_plan";

type Named = Pick<PlanPortal, "id" | "name" | "joint" | "landmarks">;

export interface ChosenPortals {
  readonly scope: Named | undefined;
  readonly tool: Named | undefined;
}

const PLACE = /\{(scope|tool):([a-z]+)\}/g;

/** Where one is chosen that leads into another joint, the words are of the first that leads into theirs. */
export function withPortals(
  text: string,
  portals: readonly Named[],
  chosen: ChosenPortals,
): string {
  return text.replace(PLACE, (_, who: "scope" | "tool", joint: string) => {
    const other = chosen[who === "scope" ? "tool" : "scope"];
    const portal =
      chosen[who]?.joint === joint
        ? chosen[who]
        : portals.find((one) => one.joint === joint && (who === "scope" || one.id !== other?.id));
    return portal === undefined ? `${joint} portal` : `${portal.name}: ${portal.landmarks}`;
  });
}

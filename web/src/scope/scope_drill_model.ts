// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which of the exercises with a scope is on, what is to be done next and what of it is marked in the picture. Pure.
import type { ScopeMessage, Vec3 } from "../protocol";
import type { Plan } from "./scope_plan";

export type Drill = NonNullable<Plan["drill"]>;
export type DrillState = NonNullable<ScopeMessage["drill"]>;
export type DrillStage = "hold" | "round" | "touch" | "line" | "done";

export function stageOf(drill: Drill, state: DrillState): DrillStage {
  if (state.held < drill.hold.length) return "hold";
  if (!state.round_done) return "round";
  if (state.touched < drill.touch.length) return "touch";
  return state.line_done ? "done" : "line";
}

/** The tour's place that is asked for; undefined where none is. */
export function askedFor(drill: Drill, state: DrillState): number | undefined {
  const stage = stageOf(drill, state);
  if (stage === "hold") return drill.hold[state.held];
  return stage === "touch" ? drill.touch[state.touched] : undefined;
}

export function drillWords(plan: Plan, drill: Drill, state: DrillState): string {
  const asked = askedFor(drill, state);
  const name = plan.points.find((point) => point.number === asked)?.name ?? "";
  switch (stageOf(drill, state)) {
    case "hold": {
      const kept = (state.hold_share * drill.hold_s).toFixed(1);
      const missing = state.level
        ? "bring it into the ring"
        : "bring it into the ring, turn the camera level";
      const so = state.hold_share > 0 ? `${kept} of ${drill.hold_s} s` : missing;
      return `${state.held + 1} of ${drill.hold.length} · ${name}: ${so}`;
    }
    case "round":
      return `Look round: turn the shaft, keep the tip · ${state.round_most} of ${drill.round_places} places`;
    case "touch":
      return `${state.touched + 1} of ${drill.touch.length} · touch: ${name}${sightWords(state)}`;
    case "line":
      return `Follow the line: ${Math.round(100 * state.line_share)} %${sightWords(state)}`;
    case "done":
      return "All exercises done.";
  }
}

function sightWords(state: DrillState): string {
  return state.probe_seen ? "" : " · the scope does not see the probe's tip";
}

export interface Bead {
  readonly atMm: Vec3;
  /** Name of the body that takes it along. */
  readonly body: string;
  readonly kind: "asked" | "line" | "passed";
}

/** Marks in the picture, as scanned. @param helps  none otherwise: an assessed hand finds them by itself */
export function beadsOf(plan: Plan, drill: Drill, state: DrillState, helps: boolean): Bead[] {
  if (!helps) return [];
  const asked = plan.points.find((point) => point.number === askedFor(drill, state));
  if (asked !== undefined) return [{ atMm: asked.at_mm, body: asked.body, kind: "asked" }];
  if (stageOf(drill, state) !== "line") return [];
  const last = Math.max(1, drill.line_mm.length - 1);
  return drill.line_mm.map((atMm, i) => ({
    atMm,
    body: drill.line_body,
    kind: state.line_share > 0 && i / last <= state.line_share ? "passed" : "line",
  }));
}

/** Whether the marks are other ones than before. */
export function sameBeads(a: readonly Bead[], b: readonly Bead[]): boolean {
  return (
    a.length === b.length &&
    a.every((bead, i) => bead.kind === b[i]?.kind && bead.atMm.every((x, k) => x === b[i]?.atMm[k]))
  );
}

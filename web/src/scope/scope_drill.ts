// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Over the round picture while an exercise is on: the ring into which a place is brought, how long it has been
// kept there, and words.
import { make, setText } from "../dom";
import { drillWords, stageOf, type Drill, type DrillState } from "./scope_drill_model";
import type { Plan } from "./scope_plan";

const SVG = "http://www.w3.org/2000/svg";
/** Of the picture's radius [svg units]. */
const RADIUS = 100;

export class ScopeDrillOverlay {
  readonly element = make("div.scope-drill");
  private readonly words = make("p.scope-drill-words", { role: "status" });
  private readonly ring = ringOf("scope-drill-ring");
  private readonly kept = ringOf("scope-drill-kept");
  private readonly svg = document.createElementNS(SVG, "svg");

  constructor() {
    this.svg.setAttribute("viewBox", `${-RADIUS} ${-RADIUS} ${2 * RADIUS} ${2 * RADIUS}`);
    this.svg.setAttribute("aria-hidden", "true");
    this.svg.append(this.ring, this.kept);
    this.element.append(this.svg, this.words);
    this.element.hidden = true;
  }

  /** @param isInJoint  nothing is shown while the scope sees no joint */
  show(plan: Plan, drill: Drill | null, state: DrillState | null, isInJoint: boolean): void {
    this.element.hidden = drill === null || state === null || !isInJoint;
    if (drill === null || state === null || !isInJoint) return;
    const radius = (RADIUS * drill.middle_deg) / (plan.field_deg / 2);
    const round = 2 * Math.PI * radius;
    for (const circle of [this.ring, this.kept]) circle.setAttribute("r", radius.toFixed(2));
    this.kept.setAttribute(
      "stroke-dasharray",
      `${(state.hold_share * round).toFixed(2)} ${round.toFixed(2)}`,
    );
    this.svg.style.display = stageOf(drill, state) === "hold" ? "" : "none";
    setText(this.words, drillWords(plan, drill, state));
  }
}

function ringOf(className: string): SVGCircleElement {
  const circle = document.createElementNS(SVG, "circle");
  circle.setAttribute("class", className);
  circle.setAttribute("transform", "rotate(-90)");
  return circle;
}

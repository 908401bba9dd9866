// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Taps and pump of the joint's fluid, for mouse and fingers, and what they show.
import { button, make, setText } from "../dom";
import type { JointFluid } from "../protocol";
import { fluidWords, type FluidAct } from "./fluid_model";

const TAPS: readonly (readonly [string, string, FluidAct, string])[] = [
  ["Fluid −", "Page down", "less", "Less pressure of the inflow"],
  ["Fluid +", "Page up", "more", "More pressure of the inflow: bleeding stops, the tissue swells"],
  ["Outflow", "End", "outflow", "Opens or closes the outflow: what flows through clears the view"],
  ["Flush", "Home", "flush", "Flushes for some seconds; dry it rinses the lens"],
  ["Dry", "0", "dry", "Looks in without fluid, or with it again"],
];

/** The key of each. */
const KEYS: Readonly<Record<string, FluidAct>> = {
  PageDown: "less",
  PageUp: "more",
  End: "outflow",
  Home: "flush",
  Digit0: "dry",
};

export function fluidAct(code: string): FluidAct | undefined {
  return KEYS[code];
}

export class FluidControls {
  /** Among the scope's controls. */
  readonly taps = make("span.scope-taps", { role: "group", "aria-label": "Fluid" });
  /** Beside the picture. */
  readonly reading = make("p.scope-fluid");
  private readonly buttons = new Map<FluidAct, HTMLButtonElement>();

  constructor(act: (act: FluidAct) => void) {
    for (const [label, key, what, title] of TAPS) {
      const tap = button(label, key, () => {
        act(what);
      });
      tap.title = title;
      this.buttons.set(what, tap);
      this.taps.append(tap);
    }
    this.show(null);
  }

  /** null: the exercise has none. */
  show(fluid: JointFluid | null): void {
    this.taps.hidden = this.reading.hidden = fluid === null;
    if (fluid === null) return;
    setText(this.reading, fluidWords(fluid));
    this.buttons.get("outflow")?.setAttribute("aria-pressed", String(fluid.outflow_open));
    this.buttons.get("dry")?.setAttribute("aria-pressed", String(fluid.dry));
  }
}

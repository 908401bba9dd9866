// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera head's focus ring, for mouse and fingers, and where it stands.
import { button, make, setText } from "../dom";
import { focusTurned, focusWords, NEAREST_STEP, WELL_SET_STEP } from "./focus_model";
import { focusBy, type ScopeAct } from "./scope_keys";

const WAYS = [
  ["Focus −", "{BracketLeft}", "focus_nearer", "Nearer: what lies near gets sharp"],
  ["Focus +", "{BracketRight}", "focus_farther", "Farther: what lies far gets sharp"],
] as const;

export class FocusControls {
  /** Among the scope's controls. */
  readonly ring = make("span.scope-taps", { role: "group", "aria-label": "Focus" });
  /** Beside the picture. */
  readonly reading = make("p.scope-focus", { role: "status" });
  private readonly buttons = new Map<ScopeAct, HTMLButtonElement>();
  private step = WELL_SET_STEP;

  /** @param onTurn  it stands at this step now */
  constructor(private readonly onTurn: (step: number) => void) {
    for (const [label, key, act, title] of WAYS) {
      const b = button(label, key, () => {
        this.turn(focusBy(act));
      });
      b.title = `${title}; Shift and the wheel do the same`;
      this.buttons.set(act, b);
      this.ring.append(b);
    }
    this.show();
  }

  /** As a camera that somebody has set well. */
  reset(): void {
    this.step = WELL_SET_STEP;
    this.show();
  }

  /** @param by  steps, nearer or, below 0, farther */
  turn(by: number): void {
    this.step = focusTurned(this.step, by);
    this.show();
  }

  private show(): void {
    setText(this.reading, focusWords(this.step));
    const ends = { focus_nearer: NEAREST_STEP, focus_farther: 0 } as const;
    for (const [, , act] of WAYS) {
      // It keeps the keyboard's focus at an end, as one that is disabled would not.
      this.buttons.get(act)?.setAttribute("aria-disabled", String(this.step === ends[act]));
    }
    this.onTurn(this.step);
  }
}

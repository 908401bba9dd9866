// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps: the current one in a sentence with its key, the rest by name.
import { make, setText } from "../dom";
import { isCompleted, STEPS, tickText, type StepText } from "../operation";
import type { SnapshotMessage } from "../protocol";

const MAX_LOG_LINES = 40;

export class StepPanel {
  readonly element: HTMLElement;
  private readonly items: {
    readonly step: StepText;
    readonly item: HTMLLIElement;
    readonly mark: HTMLElement;
  }[];
  private readonly announcer = make("p.visually-hidden", { "aria-live": "polite" });
  private readonly log = make("ol.log", { "aria-label": "What happened", tabindex: "0" });
  private shown = "";

  constructor() {
    this.items = STEPS.filter((step) => step.id !== "finished").map((step, index) => {
      const mark = make("span.step-mark", { "aria-hidden": "true" }, String(index + 1));
      const item = make(
        "li",
        {},
        mark,
        make(
          "div",
          {},
          make("span.step-name", {}, step.name),
          make("p.step-sentence", {}, step.sentence),
          make("p.step-keys", {}, make("kbd", {}, step.keys)),
        ),
      );
      return { step, item, mark };
    });
    this.element = make(
      "nav.steps",
      { "aria-label": "Steps" },
      make("header.panel-title", {}, make("h2", {}, "Steps")),
      make("ol.step-list", {}, ...this.items.map(({ item }) => item)),
      this.announcer,
      make("h3.log-title", {}, "Log"),
      this.log,
    );
  }

  show(s: SnapshotMessage): void {
    const state = `${s.step} ${s.completed_steps}`;
    if (state === this.shown) return;
    this.shown = state;
    this.items.forEach(({ step, item, mark }, index) => {
      const current = step.id === s.step;
      const done = isCompleted(s.completed_steps, step);
      item.classList.toggle("current", current);
      item.classList.toggle("done", done);
      setText(mark, done ? "✓" : String(index + 1));
      if (current) {
        item.setAttribute("aria-current", "step");
        setText(this.announcer, `${step.name}: ${step.sentence}`);
        item.scrollIntoView({ block: "nearest" });
      } else {
        item.removeAttribute("aria-current");
      }
    });
  }

  addLog(tickMs: number, text: string): void {
    this.log.append(make("li", {}, make("time", {}, tickText(tickMs)), text));
    while (this.log.childElementCount > MAX_LOG_LINES) this.log.firstElementChild?.remove();
    this.log.scrollTop = this.log.scrollHeight;
  }

  clearLog(): void {
    this.log.replaceChildren();
  }
}

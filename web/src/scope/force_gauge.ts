// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How hard scope and probe press: a bar with the limits of warning and injury. Both hold their peak
// for a moment, for a blow is shorter than a look.
import { make, setText } from "../dom";
import { gradeOf, type ForceGrade } from "./force_limits";

const MOST_N = 12;
const HELD_MS = 700;

/** The greatest of the last moment. */
export class HeldPeak {
  private peakN = 0;
  private atMs = -Infinity;

  at(newtons: number, nowMs: number): number {
    if (newtons >= this.peakN || nowMs - this.atMs > HELD_MS) {
      this.peakN = newtons;
      this.atMs = nowMs;
    }
    return this.peakN;
  }
}

const WORDS: Readonly<Record<ForceGrade, string>> = {
  good: "",
  warning: " · too hard",
  injury: " · injures cartilage",
};

/** What is said over the picture, of a hand that presses; nothing while it does no harm. */
export function pressWords(name: string, newtons: number): string {
  const force = `${newtons.toFixed(1)} N`;
  return {
    good: "",
    warning: `${name} presses too hard, ${force}: stop, or draw it back`,
    injury: `${name} injures cartilage, ${force}: draw it back`,
  }[gradeOf(newtons)];
}

export class ForceGauge {
  readonly element = make("div.scope-force", {});
  /** Over the picture, where one looks. The bars' words are read aloud. */
  readonly over = make("p.scope-press", { "aria-hidden": "true" });
  private readonly bars = ["Scope", "Probe"].map((name) => {
    const fill = make("span.scope-force-fill", {});
    const text = make("span.scope-force-text", { role: "status" });
    const bar = make("div.scope-force-bar", { "aria-hidden": "true" }, fill);
    this.element.append(make("div.scope-force-row", {}, text, bar));
    return { name, fill, text, bar, peak: new HeldPeak() };
  });

  /** @param newtons  by hand */
  show(newtons: readonly number[], nowMs: number): void {
    let hardest = { name: "", peak: 0 };
    this.bars.forEach((one, hand) => {
      const peak = one.peak.at(newtons[hand] ?? 0, nowMs);
      if (peak > hardest.peak) hardest = { name: one.name, peak };
      const grade = gradeOf(peak);
      one.bar.dataset["grade"] = grade;
      one.fill.style.width = `${(100 * Math.min(1, peak / MOST_N)).toFixed(1)}%`;
      setText(one.text, `${one.name} ${peak.toFixed(1)} N${WORDS[grade]}`);
      one.text.dataset["grade"] = grade;
    });
    const words = pressWords(hardest.name, hardest.peak);
    this.over.hidden = words === "";
    this.over.dataset["grade"] = gradeOf(hardest.peak);
    setText(this.over, words);
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The length of an operation with its events on it; one drags to any moment.
import { make, setText } from "../dom";
import { tickText } from "../operation";
import type { Mark, MarkKind } from "./replay_marks_model";

const NAMES: Readonly<Record<MarkKind, string>> = {
  picture: "picture",
  entry: "bone entered",
  harm: "harm",
  step: "step done",
  undo: "undo",
};

export class ScrubBar {
  readonly element: HTMLElement;
  private readonly range: HTMLInputElement;
  private readonly time = make("output.scrub-time");
  private readonly said = make("span.scrub-mark-text");

  /** @param label  for who does not see it; @param onMove  to a tick */
  constructor(
    label: string,
    private readonly length: number,
    marks: readonly Mark[],
    onMove: (tick: number) => void,
  ) {
    this.range = make("input", {
      type: "range",
      min: "0",
      max: String(length),
      step: "1",
      value: "0",
      "aria-label": label,
    });
    this.range.addEventListener("input", () => {
      onMove(Number(this.range.value));
    });
    const track = make("div.scrub-marks", { "aria-hidden": "true" });
    for (const mark of marks) {
      const sign = make(`span.scrub-mark.${mark.kind}` as "span");
      sign.style.left = `${(100 * mark.tick) / Math.max(1, length)}%`;
      sign.title = `${tickText(mark.tick)} ${mark.text}`;
      sign.addEventListener("pointerenter", () => {
        setText(this.said, `${tickText(mark.tick)} ${mark.text}`);
      });
      sign.addEventListener("pointerleave", () => {
        setText(this.said, "");
      });
      sign.addEventListener("click", () => {
        onMove(mark.tick);
      });
      track.append(sign);
    }
    this.element = make(
      "div.scrub",
      {},
      make("div.scrub-line", {}, this.range, track),
      make("div.scrub-foot", {}, this.time, this.said, legend(marks)),
    );
    this.show(0);
  }

  show(tick: number): void {
    const at = Math.round(tick);
    if (Number(this.range.value) !== at) this.range.value = String(at);
    const says = `${tickText(tick)} of ${tickText(this.length)}`;
    setText(this.time, says);
    this.range.setAttribute("aria-valuetext", says);
  }
}

function legend(marks: readonly Mark[]): HTMLElement {
  const kinds = (Object.keys(NAMES) as MarkKind[]).filter((kind) =>
    marks.some((mark) => mark.kind === kind),
  );
  return make(
    "span.scrub-legend.secondary",
    {},
    ...kinds.map((kind) =>
      make(
        "span",
        {},
        make(`span.scrub-mark.${kind}` as "span", { "aria-hidden": "true" }),
        NAMES[kind],
      ),
    ),
  );
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether the fracture is displaced: asked at the step that judges it, answered before anything is
// drilled, right or wrong told afterwards.
import { make } from "../dom";
import type { SnapshotMessage } from "../protocol";
import "./displacement_question.css";

export class DisplacementQuestion {
  readonly element: HTMLElement;
  private readonly aligned = make("button", { type: "button" }, "Aligned");
  private readonly displaced = make("button", { type: "button" }, "Displaced");

  constructor(onAnswer: (displaced: boolean) => void) {
    this.element = make(
      "div.displacement-question",
      { role: "group", "aria-label": "The fracture is" },
      this.aligned,
      this.displaced,
    );
    this.aligned.addEventListener("click", () => {
      onAnswer(false);
    });
    this.displaced.addEventListener("click", () => {
      onAnswer(true);
    });
  }

  /** @param isOpen  it can be answered, or answered otherwise, still */
  show({ judged_displaced: judged }: SnapshotMessage, isOpen: boolean): void {
    this.aligned.disabled = this.displaced.disabled = !isOpen;
    this.aligned.setAttribute("aria-pressed", String(judged === false));
    this.displaced.setAttribute("aria-pressed", String(judged === true));
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The report of an examination: of each structure one grade, the healthy one to choose like any other; none
// is chosen beforehand. Each choice is told at once, the newest counts.
import { inOrder } from "../case_data";
import { button, make, setText } from "../dom";
import { reportOf, WHAT_IS_ASKED } from "./findings_words_model";
import type { Plan } from "./scope_plan";
import "./findings_dialog.css";

export class FindingsDialog {
  readonly element: HTMLDialogElement;
  private readonly rows = make("div.findings-rows");
  private readonly intro = make("p");
  /** Of the operation before. */
  private readonly report = make("p.findings-report");
  private findings: Plan["findings"] = [];
  /** Answers given since it was opened that the host did not tell back yet: a grade by its finding. */
  private readonly given = new Map<string, string>();

  constructor(private readonly onAnswer: (finding: string, grade: string) => void) {
    const form = make(
      "form",
      { method: "dialog" },
      make("h2", { id: "findings-title" }, "Findings"),
      this.intro,
      this.report,
      this.rows,
      make(
        "div.actions",
        {},
        button(
          "Back to the joint",
          "Esc",
          () => {
            this.element.close();
          },
          ".primary",
        ),
      ),
    );
    // Not a change alone: who looks again and finds the same says so by the same answer.
    form.addEventListener("click", (event) => {
      const input = event.target;
      if (!(input instanceof HTMLInputElement && input.type === "radio")) return;
      this.given.set(input.name, input.value);
      this.onAnswer(input.name, input.value);
    });
    this.element = make("dialog.findings", { "aria-labelledby": "findings-title" }, form);
  }

  set(findings: Plan["findings"], screw: Plan["screw"]): void {
    this.findings = findings;
    setText(this.intro, screw === null ? WHAT_IS_ASKED.structures : WHAT_IS_ASKED.screw);
    setText(this.report, reportOf(screw));
    this.report.hidden = screw === null;
    this.rows.replaceChildren(
      ...findings.map((finding) =>
        make(
          "div.finding",
          { role: "radiogroup", "aria-label": finding.label },
          make(
            "span.finding-name",
            {},
            finding.label,
            ...(finding.scale === "" ? [] : [make("small", {}, ` ${finding.scale}`)]),
          ),
          ...inOrder(finding.grades).map((grade) =>
            make(
              "label",
              { title: grade.label },
              make("input", {
                type: "radio",
                name: finding.id,
                value: grade.id,
                "aria-label": `${finding.label}: ${grade.label}`,
              }),
              make("span", {}, grade.id === "0" || finding.scale === "" ? grade.label : grade.id),
            ),
          ),
        ),
      ),
    );
  }

  /** @param answers  by finding, what the host has; -1: nothing yet */
  open(answers: readonly number[]): void {
    if (this.element.open || this.findings.length === 0) return;
    this.given.clear();
    this.showAnswers(answers);
    this.element.showModal();
  }

  /** As the host tells them: one given just before it was opened comes while one reads. */
  see(answers: readonly number[]): void {
    if (this.element.open) this.showAnswers(answers);
  }

  private showAnswers(answers: readonly number[]): void {
    this.findings.forEach((finding, f) => {
      const kept = finding.grades[answers[f] ?? -1]?.id;
      if (this.given.get(finding.id) === kept) this.given.delete(finding.id);
      if (this.given.has(finding.id)) return;
      for (const input of this.rows.querySelectorAll<HTMLInputElement>(
        `input[name="${finding.id}"]`,
      ))
        input.checked = input.value === kept;
    });
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong in a case's joints, for instructors: at random, nothing, as chosen, or as a number draws
// it. The host keeps it beside the case, and refuses whoever is no instructor.
import { fetchCasePathology, inOrder, savePathology } from "../case_data";
import { button, make, setText } from "../dom";
import type { CasePathology, Finding } from "../protocol";
import "./pathology.css";
import {
  draftOf,
  heldText,
  problemOf,
  wishOf,
  withGrade,
  type PathologyDraft,
  type PathologyKind,
} from "./pathology_model";

const KINDS: readonly {
  readonly kind: PathologyKind;
  readonly title: string;
  readonly text: string;
}[] = [
  { kind: "random", title: "At random", text: "Each examination draws anew." },
  { kind: "healthy", title: "Healthy", text: "Nothing is wrong, in each examination." },
  { kind: "chosen", title: "Chosen", text: "As set below; all else is well." },
  { kind: "seed", title: "By a number", text: "What it draws, the same for everybody." },
];
const UNKNOWN: PathologyDraft = { kind: "random", grades: new Map(), seed: "" };

function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

export class PathologyDialog {
  readonly element: HTMLDialogElement;
  private readonly heading = make("h2", { id: "pathology-title" });
  private readonly kinds = make("fieldset.pathology-kinds");
  private readonly rows = make("div.pathology-rows");
  private readonly seed = make("input", {
    type: "text",
    inputmode: "numeric",
    autocomplete: "off",
    maxlength: "16",
    "aria-label": "The number",
  });
  private readonly note = make("p.pathology-note", { role: "status" });
  private readonly save = make("button.primary", { type: "submit" }, "Save");
  private caseId = "";
  private findings: readonly Finding[] = [];
  private draft = UNKNOWN;

  constructor() {
    const form = make(
      "form",
      { method: "dialog", novalidate: "" },
      this.heading,
      make(
        "p.secondary",
        {},
        "What an examination by scope finds. Generated, not seen in the CT. Trainees are told with their " +
          "score, not before; whoever has examined this case then knows it.",
      ),
      this.kinds,
      this.rows,
      this.note,
      make(
        "div.actions",
        {},
        button("Close", "Esc", () => {
          this.element.close();
        }),
        this.save,
      ),
    );
    this.kinds.append(make("legend", {}, "What is wrong"), ...KINDS.map((one) => this.kind(one)));
    this.seed.addEventListener("input", () => {
      this.change({ kind: "seed", seed: this.seed.value });
    });
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.send();
    });
    this.element = make("dialog.pathology", { "aria-labelledby": "pathology-title" }, form);
    // Keys of the page behind it are not meant.
    this.element.addEventListener("keydown", (event) => {
      event.stopPropagation();
    });
    this.element.addEventListener("close", () => {
      this.element.remove();
    });
  }

  /** @param title  of the case, as it is listed */
  open(caseId: string, title: string): void {
    this.caseId = caseId;
    setText(this.heading, `Pathology of “${title}”`);
    this.take({ may_prepare: true, findings: [], prepared: null });
    this.say("Loading…");
    document.body.append(this.element);
    this.element.showModal();
    fetchCasePathology(caseId).then(
      (told) => {
        this.take(told);
        this.kinds.querySelector<HTMLInputElement>("input:checked")?.focus();
      },
      (error: unknown) => {
        this.say(messageOf(error), true);
      },
    );
  }

  private kind(one: (typeof KINDS)[number]): HTMLElement {
    const input = make("input", { type: "radio", name: "pathology-kind", value: one.kind });
    input.addEventListener("change", () => {
      this.change({ kind: one.kind });
    });
    const said = make("span", {}, make("strong", {}, one.title), make("small", {}, one.text));
    return make(
      "div.pathology-kind",
      {},
      make("label", {}, input, said),
      ...(one.kind === "seed" ? [this.seed] : []),
    );
  }

  private take(told: CasePathology): void {
    this.findings = told.findings;
    this.draft = told.prepared === null ? UNKNOWN : draftOf(told.prepared);
    this.kinds.disabled = this.save.disabled = told.prepared === null;
    this.rows.replaceChildren(...this.findings.map((finding) => this.row(finding)));
    this.fill();
    this.seed.value = this.draft.seed;
    this.say(told.prepared === null ? "" : heldText(told.prepared, told.findings));
  }

  private row(finding: Finding): HTMLElement {
    const choice = make(
      "select",
      { id: `pathology-${finding.id}` },
      ...inOrder(finding.grades).map((grade) => make("option", { value: grade.id }, grade.label)),
    );
    choice.addEventListener("change", () => {
      this.draft = withGrade(this.draft, finding.id, choice.value);
      this.change({});
    });
    return make(
      "div.pathology-row",
      {},
      make(
        "label",
        { for: choice.id },
        finding.label,
        ...(finding.scale === "" ? [] : [make("small", {}, ` ${finding.scale}`)]),
      ),
      choice,
    );
  }

  private change(part: Partial<PathologyDraft>): void {
    this.draft = { ...this.draft, ...part };
    this.fill();
    const problem = problemOf(this.draft);
    this.say(problem === "" ? "Not saved yet." : problem, problem !== "");
    this.save.disabled = problem !== "";
  }

  private fill(): void {
    const { kind, grades } = this.draft;
    for (const input of this.kinds.querySelectorAll<HTMLInputElement>("input[type=radio]")) {
      input.checked = input.value === kind;
    }
    this.rows.hidden = kind !== "chosen";
    this.seed.hidden = kind !== "seed";
    for (const finding of this.findings) {
      const choice = this.rows.querySelector<HTMLSelectElement>(`#pathology-${finding.id}`);
      if (choice === null) continue;
      choice.value = grades.get(finding.id) ?? finding.grades[0]?.id ?? "";
      choice.classList.toggle("is-wrong", grades.has(finding.id));
    }
  }

  private async send(): Promise<void> {
    this.save.disabled = true;
    this.say("Saving…");
    try {
      const told = await savePathology(this.caseId, wishOf(this.draft));
      this.take(told);
      this.say(`Saved, from the next examination on. ${this.note.textContent}`);
    } catch (error) {
      this.save.disabled = false;
      this.say(messageOf(error), true);
    }
  }

  private say(text: string, isProblem = false): void {
    this.note.classList.toggle("harm", isProblem);
    setText(this.note, text);
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who operates, on which case, and that it is no patient where it is none.
import { button, make, remember, remembered, setText } from "../dom";
import type { CaseDescription, CaseList, Mode, ProcedureSummary } from "../protocol";
import { nameField, rememberName } from "../trainee_name";
import { doubtText, scanDoubts } from "./card_text_model";
import { CaseCards } from "./case_cards";
import "./start_dialog.css";
import { withTimesSigns } from "./times_sign_model";

export interface StartChoice {
  readonly trainee: string;
  /** Id of what is to be practised; empty where the host offers nothing. */
  readonly procedure: string;
  readonly mode: Mode;
}

const PROCEDURE_KEY = "carpus.procedure";
const MODE_KEY = "carpus.mode";

const MODES: readonly { readonly mode: Mode; readonly title: string; readonly text: string }[] = [
  {
    mode: "practice",
    title: "Practice",
    text: "Bones can be seen, steps are ticked off, mistakes can be taken back.",
  },
  {
    mode: "assessed",
    title: "Assessed",
    text: "Closed skin and the C-arm, as in theatre. Nothing is taken back; the truth comes afterwards.",
  },
];
/** ", scaphoid in 2 parts" of the bones that the scene has in parts. */
function brokenText(bones: readonly string[]): string {
  const parts = new Map<string, number>();
  for (const name of bones) {
    const [bone, part] = name.split("_");
    if (bone !== undefined && part !== undefined) parts.set(bone, (parts.get(bone) ?? 0) + 1);
  }
  return [...parts].map(([bone, count]) => `, ${bone} in ${count} parts`).join("");
}

export class StartDialog {
  readonly element: HTMLDialogElement;
  private readonly name: HTMLInputElement;
  private readonly start: HTMLButtonElement;
  private readonly resume: HTMLButtonElement;
  private readonly end: HTMLButtonElement;
  private cards: CaseCards | undefined;
  /** Of instructors; not where one is to be assessed. */
  private readonly prepare = make("span.start-scan");
  private readonly note = make("p.start-note", { role: "status" });

  constructor(
    description: CaseDescription,
    private readonly procedures: readonly ProcedureSummary[],
    onStart: (choice: StartChoice) => void,
    onResume: (choice: StartChoice) => void,
    onEnd: () => void,
  ) {
    this.name = nameField("trainee-name");
    this.start = make("button.primary", { type: "submit" }, "Start");
    this.resume = button("Go on with the running exercise", "", () => {
      onResume(this.choice());
    });
    this.end = button("End that operation…", "", onEnd);
    this.resume.hidden = this.end.hidden = true;
    const form = make(
      "form",
      { method: "dialog" },
      make(
        "header.start-head",
        {},
        make("img", { src: "/carpus.svg", alt: "", width: "40", height: "40" }),
        make(
          "div",
          {},
          make("h1", { id: "start-title" }, "Carpus"),
          make("p.secondary", {}, "Wrist surgery, for training"),
        ),
      ),
      this.facts(description),
      make("label", { for: "trainee-name" }, "Your name, for the list of attempts"),
      this.name,
      this.procedureChoice(),
      this.modeChoice(),
      this.note,
      make(
        "div.actions",
        {},
        make(
          "span.start-link",
          {},
          make("a", { href: "#/attempts" }, "Past attempts"),
          " · ",
          make("a", { href: "#/views" }, "View quiz"),
          make("span.start-scan", {}, " · ", make("a", { href: "#/scan" }, "Scan")),
          this.prepare,
        ),
        this.end,
        this.resume,
        this.start,
      ),
      make("p.start-foot", {}, "For training and research. Not a medical device."),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      onStart(this.choice());
    });
    this.element = make("dialog.start", { "aria-labelledby": "start-title" }, form);
    form.addEventListener("change", () => {
      this.followMode();
    });
    this.followMode();
    // Escape has nothing to go back to.
    this.element.addEventListener("cancel", (event) => {
      event.preventDefault();
    });
  }

  private facts(d: CaseDescription): HTMLElement {
    const row = (term: string, ...value: (Node | string)[]): Node[] => [
      make("dt", {}, term),
      make("dd", {}, ...value),
    ];
    const patient: (Node | string)[] = [d.pseudonym];
    if (d.simulated) patient.push(" ", make("span.badge", {}, "simulated"));
    const flexion = Math.round(d.scan.flexion_deg);
    const scanned =
      flexion === 0 ? "straight" : `${flexion > 0 ? "flexed" : "extended"} ${Math.abs(flexion)}°`;
    return make(
      "dl.start-facts",
      {},
      ...row("Case", ...patient),
      ...row(
        "Side",
        `${d.side} wrist, scanned ${scanned}`,
        make("span.start-diagnosis", {}, brokenText(d.bones)),
      ),
      ...row(
        "From",
        make("span.start-diagnosis", {}, d.source === "" ? "not stated" : withTimesSigns(d.source)),
        make("span.start-untold", {}, "told afterwards"),
      ),
    );
  }

  private procedureChoice(): HTMLElement {
    const last = remembered(PROCEDURE_KEY);
    const chosen = this.procedures.find((one) => one.id === last) ?? this.procedures[0];
    return make(
      "fieldset.start-procedures",
      {},
      make("legend", {}, "Procedure"),
      ...this.procedures.map((procedure) => {
        const input = make("input", { type: "radio", name: "procedure", value: procedure.id });
        input.checked = procedure === chosen;
        return make(
          "label",
          {},
          input,
          make(
            "span",
            {},
            make("strong", {}, procedure.title),
            make("span.secondary", {}, procedure.summary),
          ),
        );
      }),
    );
  }

  private modeChoice(): HTMLElement {
    const last = remembered(MODE_KEY);
    const chosen = MODES.find((one) => one.mode === last) ?? MODES[0];
    return make(
      "fieldset.start-procedures.start-modes",
      {},
      make("legend", {}, "How"),
      ...MODES.map((one) => {
        const input = make("input", { type: "radio", name: "mode", value: one.mode });
        input.checked = one === chosen;
        return make(
          "label",
          {},
          input,
          make("span", {}, make("strong", {}, one.title), make("span.secondary", {}, one.text)),
        );
      }),
    );
  }

  private choice(): StartChoice {
    const trainee = this.name.value.trim();
    const checked = this.element.querySelector<HTMLInputElement>("input[name=procedure]:checked");
    const procedure = checked?.value ?? "";
    const { mode } = this;
    remember(MODE_KEY, mode);
    rememberName(trainee);
    remember(PROCEDURE_KEY, procedure);
    return { trainee, procedure, mode };
  }

  /** What can be chosen, before what is known of the open one; nothing where there is no choice. */
  showCases(list: CaseList, choose: (id: string) => void): void {
    const open = list.cases.find((one) => one.id === list.open);
    const doubt = doubtText(open?.flagged ?? []);
    const said = (mode: Mode): HTMLElement[] =>
      scanDoubts(open?.of_scan ?? [], mode).map((text) =>
        make(`p.case-card-doubt.start-${mode === "practice" ? "diagnosis" : "untold"}`, {}, text),
      );
    this.element
      .querySelector(".start-facts")
      ?.after(
        ...(doubt === "" ? [] : [make("p.case-card-doubt", {}, `${doubt} before you operate.`)]),
        ...said("practice"),
        ...said("assessed"),
      );
    const [only] = list.cases;
    // One case is no choice; what is to be learnt of it is told all the same.
    if (list.cases.length < 2 && (only?.goal ?? "") === "") return;
    this.cards = new CaseCards(list, choose);
    this.cards.show(this.mode);
    this.element.querySelector(".start-facts")?.before(this.cards.element);
  }

  /** For instructors: the way to what is wrong in the open case. */
  offerPathology(open: () => void): void {
    this.prepare.replaceChildren(" · ", button("Pathology…", "", open, ".start-way"));
  }

  private get mode(): Mode {
    const input = this.element.querySelector<HTMLInputElement>("input[name=mode]:checked");
    return input?.value === "assessed" ? "assessed" : "practice";
  }

  /** What the way to operate leaves to be found out is not told beforehand. */
  private followMode(): void {
    this.element.classList.toggle("assessed", this.mode === "assessed");
    this.cards?.show(this.mode);
  }

  open(): void {
    if (this.element.open) return;
    this.element.showModal();
    this.nextStep().focus({ preventScroll: true });
  }

  private nextStep(): HTMLElement {
    return this.resume.hidden ? this.name : this.resume;
  }

  close(): void {
    this.element.close();
  }

  /** Whether the host can take a start now; if not, why. */
  setReady(ready: boolean, note: string): void {
    this.start.disabled = !ready;
    setText(this.note, note);
    this.note.hidden = note === "";
  }

  /** Another page operates, which this one may end. */
  offerEnd(on: boolean): void {
    this.end.hidden = !on;
  }

  /** Going on comes before starting anew. */
  offerResume(on: boolean): void {
    if (this.resume.hidden === !on) return;
    this.resume.hidden = !on;
    this.resume.classList.toggle("primary", on);
    this.start.classList.toggle("primary", !on);
    setText(this.start, on ? "Start anew" : "Start");
    if (this.element.open) this.nextStep().focus({ preventScroll: true });
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps: the current one in a sentence with its key, the rest by name.
import { make, setText } from "../dom";
import { keyCap } from "../key_caps";
import { keysOf, tickText, type OfferedActions } from "../operation";
import type { ExerciseMessage, SnapshotMessage, Step } from "../protocol";
import { DisplacementQuestion } from "./displacement_question";
import "./step_panel.css";

const MAX_LOG_LINES = 40;

interface ShownStep {
  readonly step: Step;
  readonly item: HTMLLIElement;
  readonly mark: HTMLElement;
  readonly sentence: HTMLElement;
  /** Goes back to it. */
  readonly again: HTMLButtonElement;
  /** Of the step that judges the fracture. */
  readonly question: DisplacementQuestion | undefined;
}

export class StepPanel {
  readonly element: HTMLElement;
  private readonly list = make("ol.step-list", {
    tabindex: "0",
    "aria-label": "Steps of the procedure",
  });
  /** On a narrow screen, where else the current step alone is shown. */
  private readonly unfold = make("button.steps-unfold.quiet", {
    type: "button",
    "aria-expanded": "false",
  });
  /** What is asked for, where no step may be told. */
  private readonly task = make("p.task", { hidden: "" });
  private items: readonly ShownStep[] = [];
  private readonly announcer = make("p.visually-hidden", { "aria-live": "polite" });
  private readonly log = make("ol.log", { "aria-label": "What happened", tabindex: "0" });
  private shown = "";
  /** Then nobody tells which step is done. */
  private isAssessed = false;

  /**
   * @param onReturn  a step is to be done again, from its place in the procedure on
   * @param onJudge  what is said of the fracture
   */
  constructor(
    firstTouch: HTMLElement,
    wrist: HTMLElement,
    private readonly onReturn: (step: number) => void,
    private readonly onJudge: (displaced: boolean) => void,
  ) {
    this.element = make(
      "nav.steps",
      { "aria-label": "Steps" },
      firstTouch,
      make("header.panel-title", {}, make("h2", {}, "Steps")),
      this.unfold,
      this.task,
      this.list,
      this.announcer,
      wrist,
      make("h3.log-title", {}, "Log"),
      this.log,
    );
    this.unfold.addEventListener("click", () => {
      this.showAll(!this.element.classList.contains("unfolded"));
    });
    this.showAll(false);
    new ResizeObserver(() => {
      this.showCurrent();
    }).observe(this.list);
  }

  /** The current step in full, as far as the panel is high: the log gives way. */
  private showCurrent(): void {
    const current = this.items.find(({ item }) => item.classList.contains("current"))?.item;
    this.list.style.setProperty("--current-step", `${current?.offsetHeight ?? 0}px`);
    current?.scrollIntoView({ block: "nearest" });
  }

  private showAll(on: boolean): void {
    this.element.classList.toggle("unfolded", on);
    this.unfold.setAttribute("aria-expanded", String(on));
    setText(this.unfold, on ? "Current step" : "All steps");
  }

  /** The steps of the procedure that is done, with the name of what each is done with. */
  setSteps({ mode, task, steps, instruments, arthroscopy }: ExerciseMessage): void {
    this.isAssessed = mode === "assessed";
    this.task.hidden = !this.isAssessed || task === null;
    setText(this.task, task ?? "");
    this.shown = "";
    this.items = steps.map((step, index) => {
      const mark = make("span.step-mark", { "aria-hidden": "true" }, String(index + 1));
      const tool = instruments.find((one) => one.id === step.instrument);
      const isOnSkin = tool !== undefined && tool.skin_work !== "none";
      const keys = keysOf(step.actions, arthroscopy !== null && !isOnSkin).map((key) =>
        keyCap(key),
      );
      const again = make("button.step-again", {
        type: "button",
        title: "Do this step again",
        "aria-label": `Do again: ${step.title}`,
      });
      again.textContent = "↺";
      again.hidden = true;
      again.addEventListener("click", () => {
        this.showAll(false);
        this.onReturn(index);
      });
      const question = step.actions.includes("judge")
        ? new DisplacementQuestion(this.onJudge)
        : undefined;
      const sentence = make("p.step-sentence", {}, step.instruction);
      const item = make(
        "li",
        {},
        mark,
        make(
          "div",
          {},
          make("span.step-name", {}, step.title),
          sentence,
          ...(question === undefined ? [] : [question.element]),
          make("p.step-keys", {}, ...(tool === undefined ? [] : [`${tool.name} `]), ...keys),
        ),
        again,
      );
      return { step, item, mark, sentence, again, question };
    });
    this.list.replaceChildren(...this.items.map(({ item }) => item));
  }

  /** @param words  a step's, with what was chosen on the page in place of its names */
  fill(words: (text: string) => string): void {
    for (const { step, sentence } of this.items) setText(sentence, words(step.instruction));
    this.showCurrent();
  }

  show(s: SnapshotMessage): void {
    const isBefore = s.passes === 0 && !s.finished;
    const state = `${s.step} ${s.completed_steps.join(" ")} ${isBefore} ${s.judged_displaced}`;
    if (state === this.shown) return;
    this.shown = state;
    this.items.forEach(({ step, item, mark, sentence, question }, index) => {
      // Nobody tells in an assessed operation which step it is: the question stands until bone is
      // entered.
      item.classList.toggle("asked", question !== undefined && isBefore);
      question?.show(s, isBefore);
      const current = index === s.step && !this.isAssessed;
      const done = s.completed_steps.includes(index);
      item.classList.toggle("current", current);
      item.classList.toggle("done", done);
      setText(mark, done ? "✓" : String(index + 1));
      if (current) {
        item.setAttribute("aria-current", "step");
        setText(this.announcer, `${step.title}: ${sentence.textContent}`);
      } else {
        item.removeAttribute("aria-current");
      }
    });
    this.showCurrent();
  }

  /** Those that the host would go back to can be done again. */
  offer(offered: OfferedActions): void {
    this.items.forEach(({ again }, step) => {
      again.hidden = offered.find({ id: "return_to_step", item: step })?.allowed !== true;
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

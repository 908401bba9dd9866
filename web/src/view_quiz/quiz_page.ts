// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The room of the view quiz: pictures to the left, questions to the right. The host knows the truth
// and tells it after the answer.
import { fetchCase } from "../case_data";
import { button, make, setText } from "../dom";
import { HostLink, openPageSocket, pageWord, type LinkState } from "../host_link";
import type {
  CArmPicture,
  HostMessage,
  PageMessage,
  QuizQuestionMessage,
  QuizTruthMessage,
} from "../protocol";
import { rememberedName } from "../trainee_name";
import { AnswerForm } from "./answer_form";
import { NamePanel } from "./name_panel";
import { PLACES, seedOf, tallyRows, viewOfPicture } from "./quiz_model";
import { QuizPicture } from "./quiz_picture";
import { TruthPanel } from "./truth_panel";
import "./view_quiz.css";

/** Shows the room in `app`; the returned function leaves it. */
export function mountViewQuiz(app: HTMLElement): () => void {
  const page = new QuizPage(app);
  return () => {
    page.dispose();
  };
}

class QuizPage {
  private readonly picture = new QuizPicture();
  private readonly viewGroup = make("div.quiz-views", {
    role: "group",
    "aria-label": "Take a picture",
  });
  private readonly tally = make("dl.quiz-tally");
  private readonly lead = make("p.quiz-lead");
  private readonly notice = make("p.notice-line", { role: "status" });
  private readonly caseName = make("p.secondary");
  private readonly namePanel: NamePanel;
  private readonly form: AnswerForm;
  private readonly truthPanel: TruthPanel;
  private readonly link: HostLink;
  private readonly abort = new AbortController();
  private question: QuizQuestionMessage | undefined;
  private truth: QuizTruthMessage | undefined;
  /** Of this question, by view. */
  private pictures = new Map<number, CArmPicture>();
  private asked = new Set<number>();
  private shown = 0;

  private name = rememberedName();

  constructor(app: HTMLElement) {
    this.namePanel = new NamePanel((name) => {
      this.name = name;
      this.begin();
    });
    this.form = new AnswerForm((choice) => {
      this.tell({ type: "quiz_answer", place: choice.place, next_view: choice.view });
    });
    this.truthPanel = new TruthPanel({
      show: (view) => {
        this.look(view);
      },
      outlines: () => {
        this.redraw();
      },
      next: () => {
        this.tell({ type: "quiz_next" });
      },
    });
    app.replaceChildren(this.layOut());
    this.say("Preparing the wrist…");
    this.link = new HostLink(openPageSocket, pageWord(), {
      onState: (state, why) => {
        this.showLink(state, why);
      },
      onMessage: (message) => {
        this.receive(message);
      },
      onPicture: (picture) => {
        this.takePicture(picture);
      },
      onRefused: () => undefined,
    });
    window.addEventListener(
      "keydown",
      (event) => {
        this.onKey(event);
      },
      { signal: this.abort.signal },
    );
    void this.nameCase();
  }

  dispose(): void {
    this.abort.abort();
    this.link.dispose();
  }

  private layOut(): HTMLElement {
    const anew = button("Begin anew", "", () => {
      this.begin();
    });
    const other = button("Another name…", "", () => {
      this.askName();
    });
    return make(
      "main.quiz",
      {},
      make("section.quiz-left", { "aria-label": "C-arm" }, this.picture.element, this.viewGroup),
      make(
        "section.quiz-right",
        { "aria-label": "Questions" },
        make(
          "header.quiz-head",
          {},
          make("div", {}, this.caseName, make("h1", {}, "Which view tells?")),
          make("a.button-link", { href: "#/" }, "Operate"),
        ),
        this.namePanel.element,
        this.lead,
        this.form.element,
        this.truthPanel.element,
        this.notice,
        make(
          "footer.quiz-foot",
          {},
          this.tally,
          make(
            "p.secondary",
            {},
            "Generated screws in this case. The first answer to a question counts; ",
            make("a", { href: "#/review" }, "how you go on"),
            " is with the learning curve.",
          ),
          make("div.quiz-ways", {}, anew, other),
        ),
      ),
    );
  }

  private async nameCase(): Promise<void> {
    try {
      const description = await fetchCase();
      this.caseName.replaceChildren(description.pseudonym);
      if (description.simulated) {
        this.caseName.append(" ", make("span.badge", {}, "simulated"));
      }
    } catch (error) {
      this.say(error instanceof Error ? error.message : String(error));
    }
  }

  /** Whose answers they are, before the first question. */
  private askName(): void {
    this.question = this.truth = undefined;
    this.pictures = new Map();
    this.lead.replaceChildren("A screw lies in a scaphoid: is it in or out, and which view tells?");
    this.form.hide();
    this.truthPanel.hide();
    this.say("");
    this.redraw();
    this.namePanel.ask();
  }

  private begin(): void {
    this.namePanel.hide();
    const seed = seedOf(location.hash) ?? crypto.getRandomValues(new Uint32Array(1))[0] ?? 1;
    if (this.tell({ type: "quiz_begin", trainee: this.name, seed }))
      this.say("Preparing the wrist…");
  }

  private tell(message: PageMessage): boolean {
    const sent = this.link.send(message);
    if (!sent) this.say("Not connected: nothing was sent. Wait for the connection.");
    return sent;
  }

  private say(text: string): void {
    setText(this.notice, text);
    this.notice.hidden = text === "";
  }

  private showLink(state: LinkState, why: string): void {
    if (state === "lost") this.say("The connection is lost. Trying again by itself…");
    if (state === "busy") {
      this.say(
        `${why === "" ? "Another page operates here." : why} This page asks again by itself.`,
      );
    }
    this.namePanel.setReady(state === "open");
    if (state !== "open") return;
    this.say("");
    if (this.question !== undefined || this.namePanel.isAsking) return;
    if (this.name === "") this.askName();
    else this.begin();
  }

  private receive(message: HostMessage): void {
    if (message.type === "quiz_question") this.ask(message);
    else if (message.type === "quiz_truth") this.tellTruth(message);
    else if (message.type === "error") this.say(`${message.reason}. ${message.what_to_do}`);
  }

  private ask(question: QuizQuestionMessage): void {
    this.question = question;
    this.truth = undefined;
    this.pictures = new Map();
    this.shown = Math.max(
      0,
      question.views.findIndex((view) => view.id === question.first_view),
    );
    this.asked = new Set([this.shown]);
    this.say("");
    this.lead.replaceChildren(
      make("strong", {}, `Question ${question.number}. `),
      `A screw lies in this scaphoid: ${question.screw}.`,
    );
    this.truthPanel.hide();
    this.form.ask(question.views);
    this.form.setTaken(this.asked);
    this.showTally();
    this.redraw();
  }

  private tellTruth(truth: QuizTruthMessage): void {
    if (this.question === undefined || truth.number !== this.question.number) return;
    this.truth = truth;
    this.say("");
    this.form.hide();
    this.truthPanel.tell(truth, this.question.views);
    this.showTally();
    this.redraw();
  }

  private showTally(): void {
    const tally = this.truth?.tally ?? this.question?.tally;
    if (tally === undefined) return;
    this.tally.replaceChildren(
      ...tallyRows(tally).map(([name, value]) =>
        make("div", {}, make("dt", {}, name), make("dd", {}, value)),
      ),
    );
  }

  /** Takes the picture, or shows it again. */
  private look(view: number): void {
    const wanted = this.question?.views[view];
    if (wanted === undefined) return;
    this.shown = view;
    if (!this.pictures.has(view) && !this.asked.has(view)) {
      if (!this.tell({ type: "quiz_look", view: wanted.id })) return;
      this.asked.add(view);
      if (this.truth === undefined) this.form.setTaken(this.asked);
    }
    this.redraw();
  }

  private takePicture(picture: CArmPicture): void {
    if (picture.kind !== "quiz" || picture.shot !== this.question?.number) return;
    const view = viewOfPicture(this.question.views, picture.rotationDeg, picture.tiltDeg);
    if (view !== undefined) this.pictures.set(view, picture);
    this.redraw();
  }

  private redraw(): void {
    const views = this.question?.views ?? [];
    const view = views[this.shown];
    const picture = this.pictures.get(this.shown);
    this.picture.show(picture, view?.label ?? "");
    this.picture.say(view !== undefined && picture === undefined ? "Taking the picture…" : "");
    const told = this.truth?.views.find((seen) => seen.view === view?.id);
    this.picture.showOutlines(this.truthPanel.showsOutlines ? told : undefined);
    this.drawViews();
  }

  private drawViews(): void {
    const views = this.question?.views ?? [];
    if (this.viewGroup.childElementCount !== views.length) {
      this.viewGroup.replaceChildren(
        ...views.map((view, index) =>
          button(view.label, String(index + 1), () => {
            this.look(index);
          }),
        ),
      );
    }
    [...this.viewGroup.children].forEach((child, index) => {
      child.setAttribute("aria-pressed", String(index === this.shown));
      child.classList.toggle("quiz-taken", this.asked.has(index));
    });
  }

  private onKey(event: KeyboardEvent): void {
    if (this.namePanel.isAsking) return;
    if (event.ctrlKey || event.altKey || event.metaKey || event.repeat) return;
    const digit = /^(?:Digit|Numpad)([1-9])$/.exec(event.code)?.[1];
    const letter = event.key.toUpperCase();
    const place = PLACES.findIndex((choice) => choice.key === letter);
    if (digit !== undefined) {
      if (event.shiftKey) this.form.chooseView(Number(digit) - 1);
      else this.look(Number(digit) - 1);
    } else if (place >= 0 && this.truth === undefined) this.form.choosePlace(place);
    else if (letter === "O") this.truthPanel.toggleOutlines();
    else if (letter === "V") this.picture.invert();
    else if (letter === "N" && this.truth !== undefined) this.tell({ type: "quiz_next" });
    else if (event.key === "Enter" && event.target === document.body) this.form.submit();
    else return;
    event.preventDefault();
  }
}

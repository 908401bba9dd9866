// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The room where one or two attempts are looked at again: play, pause, any moment, any speed.
import { dateText, procedureText } from "../attempts_list";
import {
  addressOfCase,
  fetchAttempt,
  fetchAttempts,
  fetchCase,
  fetchProcedures,
} from "../case_data";
import { button, make, setText } from "../dom";
import { tickText } from "../operation";
import type { Attempt, AttemptSummary, CaseDescription, ProcedureSummary } from "../protocol";
import { loadCaseScene, VIEWS, type ViewId } from "../theatre";
import { fetchExercise } from "./replay_client";
import { followedTick, neighbourOf, pairSteps, waitsAt, type StepPair } from "./replay_marks_model";
import { ReplayStage } from "./replay_stage";
import { truthOf } from "./truth_model";
import "./replay.css";

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8, 16] as const;
const VIEW_NAMES: Readonly<Record<ViewId, string>> = {
  dorsal: "Dorsal",
  radial: "Radial",
  volar: "Volar",
  ulnar: "Ulnar",
  wire: "Along shaft",
};

declare global {
  interface Window {
    /** For tests: what is shown. */
    carpusReplay?: {
      ticks(): (number | undefined)[];
      goTo(tick: number): void;
      hashes(): (string | undefined)[];
      pagePoint(which: number, mm: readonly [number, number, number]): { x: number; y: number };
    };
  }
}

/** Shows the room in `app`; the returned function leaves it. @param from  in seconds */
export function mountReplay(app: HTMLElement, ids: readonly number[], from: number): () => void {
  let left = false;
  let page: ReplayPage | undefined;
  let elsewhere: Attempt | undefined;
  const waiting = make("main.waiting", {}, make("p", { role: "status" }, "Loading the replay…"));
  app.replaceChildren(waiting);
  void (async () => {
    try {
      const [description, procedures, attempts, list] = await Promise.all([
        fetchCase(),
        fetchProcedures(),
        Promise.all(ids.map(fetchAttempt)),
        fetchAttempts(),
      ]);
      elsewhere = attempts.find((one) => !one.case_is_open && one.case_here !== "");
      const stages = await Promise.all(
        attempts.map(async (attempt) => ({
          attempt,
          exercise: await fetchExercise(attempt.id),
          // Each theatre moves bones of its own.
          scene: await loadCaseScene("/api/scene.glb"),
        })),
      );
      if (left) return;
      page = new ReplayPage(app, description, procedures, stages, list.attempts);
      page.goTo(Math.round(from * 1000));
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      waiting.replaceChildren(
        make("h1", {}, "The replay cannot be shown"),
        make("p", { role: "alert" }, why),
        ...(elsewhere === undefined ? [] : [wayToCase(elsewhere, ids)]),
        make("p", {}, make("a", { href: "#/attempts" }, "All past attempts")),
      );
    }
  })();
  return () => {
    left = true;
    page?.dispose();
  };
}

/** Opens the case of an attempt, and then the replay of what was asked for. */
function wayToCase(attempt: Attempt, ids: readonly number[]): HTMLElement {
  const href = addressOfCase(attempt.case_here, `replay/${ids.join("/")}`);
  return make("p", {}, make("a.button-link.primary", { href }, `Open its case, ${attempt.case}`));
}

interface Shown {
  readonly attempt: Attempt;
  readonly exercise: Awaited<ReturnType<typeof fetchExercise>>;
  readonly scene: Awaited<ReturnType<typeof loadCaseScene>>;
}

class ReplayPage {
  private readonly stages: readonly ReplayStage[];
  private readonly attempts: readonly Attempt[];
  private readonly ticks: number[];
  private readonly pairs: readonly StepPair[];
  private readonly abort = new AbortController();
  private readonly playButton: HTMLButtonElement;
  private readonly truthButton: HTMLButtonElement;
  private readonly lockButton: HTMLButtonElement;
  private readonly speedText = make("span.replay-speed");
  private readonly notice = make("p.notice-line", { role: "status" });
  private plays = false;
  private speed = 1;
  private locked = false;
  private truth: boolean;
  private view = 0;
  /** Which is moved by keys. */
  private active = 0;
  private atMs = performance.now();
  private frame = 0;

  constructor(
    app: HTMLElement,
    description: CaseDescription,
    private readonly procedures: readonly ProcedureSummary[],
    shown: readonly Shown[],
    others: readonly AttemptSummary[],
  ) {
    this.attempts = shown.map((one) => one.attempt);
    this.ticks = shown.map(() => 0);
    this.truth = shown.every((one) => one.exercise.mode === "practice");
    this.playButton = button("Play", "{Space}", () => {
      this.play(!this.plays);
    });
    this.playButton.classList.add("primary");
    this.truthButton = button("Bones", "{KeyB}", () => {
      this.showTruth(!this.truth);
    });
    this.lockButton = button("Together by step", "{KeyL}", () => {
      this.lock(!this.locked);
    });
    const places = make("div.replay-stages");
    places.classList.toggle("two", shown.length > 1);
    app.replaceChildren(
      make(
        "main.replay",
        {},
        this.head(description, others),
        places,
        this.controls(shown.length > 1),
      ),
    );
    this.stages = shown.map((one, index) => {
      const stage = new ReplayStage(
        one.attempt,
        one.exercise,
        description,
        one.scene,
        this.titleOf(one.attempt),
        {
          moved: (tick) => {
            this.active = index;
            this.move(index, tick);
          },
          say: (text) => {
            this.say(text);
          },
        },
      );
      // The theatre takes its size from its place, so that must stand in the page first.
      places.append(stage.element);
      return stage;
    });
    if (shown.length === 1) places.append(this.log());
    const [first, second] = this.attempts;
    this.pairs =
      first !== undefined && second !== undefined
        ? pairSteps(first.events ?? [], second.events ?? [], [
            this.stages[0]?.length ?? 0,
            this.stages[1]?.length ?? 0,
          ])
        : [];
    this.lockButton.disabled = !this.canLock();
    this.lock(this.canLock());
    this.showTruth(this.truth);
    this.showSpeed();
    window.addEventListener(
      "keydown",
      (event) => {
        this.onKey(event);
      },
      { signal: this.abort.signal },
    );
    window.carpusReplay = {
      ticks: () => this.stages.map((stage) => stage.shownTick),
      goTo: (tick) => {
        this.goTo(tick);
      },
      hashes: () => this.stages.map((stage) => stage.shownState?.snapshot.state_hash),
      pagePoint: (which, mm) => this.stages[which]?.pagePoint(mm) ?? { x: 0, y: 0 },
    };
    this.run();
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.abort.abort();
    delete window.carpusReplay;
    for (const stage of this.stages) stage.dispose();
  }

  /** The first attempt to a moment, the other with it. */
  goTo(tick: number): void {
    this.move(0, tick);
  }

  private titleOf(attempt: Attempt): string {
    const who = attempt.trainee === "" ? "not named" : attempt.trainee;
    const score = attempt.overall === null ? "" : `, ${Math.round(attempt.overall)} of 100`;
    return `Attempt ${attempt.id}, ${who}${score}`;
  }

  private head(description: CaseDescription, others: readonly AttemptSummary[]): HTMLElement {
    const [first] = this.attempts;
    const about =
      first === undefined
        ? ""
        : [
            description.pseudonym,
            procedureText(first.procedure, this.procedures),
            first.mode ?? "",
            dateText(first.started_at),
          ]
            .filter((part) => part !== "")
            .join(" · ");
    return make(
      "header.replay-head",
      {},
      make("h1", {}, "Replay"),
      make(
        "p.secondary",
        {},
        about,
        " ",
        description.simulated ? make("span.badge", {}, "simulated") : "",
      ),
      make(
        "nav.page-ways",
        { "aria-label": "Where to" },
        this.choice(others),
        make("a.button-link", { href: `#/attempts/${first?.id ?? 0}` }, "Report"),
        make("a.button-link", { href: "#/attempts" }, "Past attempts"),
      ),
    );
  }

  /** Another attempt beside this one, of the same case. */
  private choice(others: readonly AttemptSummary[]): HTMLElement {
    const [first, second] = this.attempts;
    const select = make("select", { id: "replay-beside" }, make("option", { value: "" }, "none"));
    for (const other of others) {
      if (other.id === first?.id || other.case_fingerprint !== first?.case_fingerprint) continue;
      const who = other.trainee === "" ? "not named" : other.trainee;
      const score = other.overall === null ? "unfinished" : `${Math.round(other.overall)} of 100`;
      const text = `${other.id}, ${who}, ${score}`;
      const option = make("option", { value: String(other.id) }, text);
      option.selected = other.id === second?.id;
      select.append(option);
    }
    select.addEventListener("change", () => {
      const beside = select.value === "" ? "" : `/${select.value}`;
      location.hash = `#/replay/${first?.id ?? 0}${beside}`;
    });
    return make("label.replay-beside", { for: "replay-beside" }, "Beside it ", select);
  }

  private controls(isTwo: boolean): HTMLElement {
    const step = (label: string, seconds: number): HTMLButtonElement =>
      button(label, "", () => {
        this.move(this.active, (this.ticks[this.active] ?? 0) + 1000 * seconds);
      });
    const event = (label: string, key: string, way: 1 | -1): HTMLButtonElement =>
      button(label, key, () => {
        this.toMark(way);
      });
    const looks = VIEWS.map((view) =>
      button(
        VIEW_NAMES[view],
        "",
        () => {
          this.look(view);
        },
        ".quiet",
      ),
    );
    return make(
      "footer.replay-controls",
      { role: "group", "aria-label": "Replay" },
      event("Event before", "P", -1),
      step("Back 10 s", -10),
      this.playButton,
      step("On 10 s", 10),
      event("Next event", "N", 1),
      button("Slower", "{Minus}", () => {
        this.changeSpeed(-1);
      }),
      this.speedText,
      button("Faster", "{Equal}", () => {
        this.changeSpeed(1);
      }),
      this.truthButton,
      ...(isTwo ? [this.lockButton] : []),
      make("span.gap"),
      this.notice,
      make("div.replay-looks", { role: "group", "aria-label": "View" }, ...looks),
    );
  }

  private log(): HTMLElement {
    const [attempt] = this.attempts;
    const events = attempt?.events ?? [];
    return make(
      "aside.replay-log",
      { "aria-label": "What happened" },
      make("h2", {}, "What happened"),
      make(
        "ol",
        {},
        ...events.map(({ tick, text }) => {
          const go = make(
            "button.quiet",
            { type: "button" },
            make("time", {}, tickText(tick)),
            make("span", {}, text),
          );
          go.addEventListener("click", () => {
            this.move(0, tick);
          });
          return make("li", {}, go);
        }),
      ),
    );
  }

  private canLock(): boolean {
    const [first, second] = this.attempts;
    return second !== undefined && first?.procedure === second.procedure;
  }

  private lock(on: boolean): void {
    this.locked = on && this.canLock();
    this.lockButton.setAttribute("aria-pressed", String(this.locked));
    if (this.locked) this.move(this.active, this.ticks[this.active] ?? 0);
  }

  private showTruth(on: boolean): void {
    const closed = this.attempts.find((attempt) => truthOf(attempt) === "closed");
    if (on && closed !== undefined) {
      this.say("Of an assessed operation without a screw the truth stays closed.");
      on = false;
    }
    this.truth = on;
    this.truthButton.setAttribute("aria-pressed", String(on));
    for (const stage of this.stages) stage.showTruth(on);
  }

  private look(view: ViewId): void {
    this.view = VIEWS.indexOf(view);
    for (const stage of this.stages) stage.lookFrom(view);
  }

  private say(text: string): void {
    setText(this.notice, text);
  }

  private play(on: boolean): void {
    // From the end it begins anew.
    const isOver = this.stages.every((stage, index) => (this.ticks[index] ?? 0) >= stage.length);
    if (on && isOver) this.ticks.fill(0);
    this.plays = on;
    this.playButton.firstChild?.replaceWith(on ? "Pause" : "Play");
    if (on) this.say("");
  }

  private changeSpeed(by: 1 | -1): void {
    const index = SPEEDS.findIndex((speed) => speed === this.speed) + by;
    this.speed = SPEEDS[index] ?? this.speed;
    this.showSpeed();
  }

  private showSpeed(): void {
    setText(this.speedText, `${this.speed}×`);
  }

  private clamp(which: number, tick: number): number {
    return Math.min(this.stages[which]?.length ?? 0, Math.max(0, Math.round(tick)));
  }

  private move(which: number, tick: number): void {
    const at = this.clamp(which, tick);
    this.ticks[which] = at;
    if (this.locked && (which === 0 || which === 1)) {
      const other = which === 0 ? 1 : 0;
      this.ticks[other] = this.clamp(other, followedTick(this.pairs, which, at));
    }
  }

  private toMark(way: 1 | -1): void {
    const mark = neighbourOf(
      this.stages[this.active]?.marks ?? [],
      this.ticks[this.active] ?? 0,
      way,
    );
    if (mark === undefined) return;
    this.move(this.active, mark.tick);
    this.say(`${tickText(mark.tick)} ${mark.text}`);
  }

  private run(): void {
    this.frame = requestAnimationFrame((now) => {
      this.advance(now - this.atMs);
      this.atMs = now;
      this.stages.forEach((stage) => {
        stage.draw();
      });
      this.run();
    });
  }

  private advance(ms: number): void {
    const there = this.stages.map((stage, index) =>
      stage.show(this.ticks[index] ?? 0, this.speed, this.plays),
    );
    // What was not heard yet is waited for: no moment is left out.
    if (!this.plays || there.includes(false)) return;
    const limits = this.locked
      ? waitsAt(this.pairs, [this.ticks[0] ?? 0, this.ticks[1] ?? 0])
      : this.stages.map((stage) => stage.length);
    this.stages.forEach((stage, index) => {
      const limit = Math.min(stage.length, limits[index] ?? stage.length);
      const at = this.ticks[index] ?? 0;
      this.ticks[index] = Math.max(at, Math.min(limit, at + Math.min(ms, 100) * this.speed));
    });
    if (this.stages.every((stage, index) => (this.ticks[index] ?? 0) >= stage.length)) {
      this.play(false);
    }
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const { target } = event;
    const isField = target instanceof HTMLSelectElement;
    const isButton = target instanceof HTMLButtonElement && event.code === "Space";
    if (isField || isButton) return;
    const by = (seconds: number): void => {
      this.move(this.active, (this.ticks[this.active] ?? 0) + 1000 * seconds);
    };
    const far = event.shiftKey ? 10 : 1;
    switch (event.code) {
      case "Space":
        this.play(!this.plays);
        break;
      case "ArrowLeft":
        by(-far);
        break;
      case "ArrowRight":
        by(far);
        break;
      case "Comma":
        by(-0.04);
        break;
      case "Period":
        by(0.04);
        break;
      case "Home":
        by(-1e6);
        break;
      case "End":
        by(1e6);
        break;
      case "KeyN":
        this.toMark(1);
        break;
      case "KeyP":
        this.toMark(-1);
        break;
      case "Minus":
      case "NumpadSubtract":
        this.changeSpeed(-1);
        break;
      case "Equal":
      case "NumpadAdd":
        this.changeSpeed(1);
        break;
      case "KeyB":
        this.showTruth(!this.truth);
        break;
      case "KeyL":
        this.lock(!this.locked);
        break;
      case "KeyI":
        for (const stage of this.stages) stage.invert();
        break;
      case "KeyV":
        this.look(VIEWS[(this.view + 1) % VIEWS.length] ?? "dorsal");
        break;
      default:
        return;
    }
    event.preventDefault();
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One attempt that is looked at again: the room's own theatre and monitor, fed with states of then.
import { Monitor, drawPicture, viewName } from "../c_arm";
import { fetchReplayPicture } from "../case_data";
import { make, setText } from "../dom";
import { faceNames, makeFrameMap } from "../frames";
import type { Attempt, CArmPicture, CaseDescription, ExerciseMessage } from "../protocol";
import { ScopeReplay } from "../scope";
import { Theatre, type CaseScene, type ViewId } from "../theatre";
import { ReplayBuffer, type ReplayState } from "./replay_buffer_model";
import { fetchStates } from "./replay_client";
import { looksOf, marksOf, type Mark } from "./replay_marks_model";
import { readingsOf } from "./readings_model";
import { ScrubBar } from "./scrub_bar";

const STRIP = 6;
const PICTURES_KEPT = 120;
/** With bones to be seen, skin is a shell about them. */
const SHELL = 0.2;
/** Live pictures came at this pace [ticks]. */
const PULSE_TICKS = 100;

export interface StageHandlers {
  moved(tick: number): void;
  say(text: string): void;
}

export class ReplayStage {
  readonly element: HTMLElement;
  readonly marks: readonly Mark[];
  readonly length: number;
  private readonly theatre: Theatre;
  private readonly monitor = new Monitor("Fluoroscopy", "c-arm-picture");
  private readonly strip = make("div.c-arm-strip", {
    role: "group",
    "aria-label": "Last pictures",
  });
  private readonly pictureName = make("span.secondary");
  private readonly readings = make("p.replay-readings");
  private readonly waiting = make("p.replay-waiting", { role: "status" });
  private readonly bar: ScrubBar;
  /** Instead of the C-arm's monitor, in an arthroscopy. */
  private readonly scope: ScopeReplay | undefined;
  private readonly buffer: ReplayBuffer;
  private readonly looks: readonly number[];
  private readonly pictures = new Map<number, CArmPicture>();
  private pictureAsked: number | undefined;
  private asking: AbortController | undefined;
  private shown: ReplayState | undefined;
  private stripShown = "";
  private monitorShown: CArmPicture | undefined;
  private failed = false;
  private inverted = false;
  private position = 0;

  constructor(
    private readonly attempt: Attempt,
    private readonly exercise: ExerciseMessage,
    description: CaseDescription,
    scene: CaseScene,
    title: string,
    private readonly handlers: StageHandlers,
  ) {
    this.length = Math.round(attempt.duration_s * 1000);
    this.buffer = new ReplayBuffer(this.length);
    this.marks = marksOf(attempt.events ?? []);
    this.looks = looksOf(attempt.events ?? []);
    const place = make("div.stage", { role: "application", "aria-label": `Theatre, ${title}` });
    this.bar = new ScrubBar(`Moment of ${title}`, this.length, this.marks, handlers.moved);
    this.monitor.sayWhileEmpty("No picture was taken yet.");
    this.scope = ScopeReplay.of(exercise, scene.jointWalls);
    this.element = make(
      "section.replay-stage",
      { "aria-label": title },
      make("h2.replay-title", {}, title),
      make(
        "div.replay-scene",
        {},
        make("div.replay-theatre", {}, place, this.waiting),
        this.scope === undefined
          ? make(
              "div.replay-monitor",
              {},
              make("header.panel-title", {}, make("h3", {}, "C-arm"), this.pictureName),
              this.monitor.element,
              this.strip,
            )
          : make(
              "div.replay-monitor",
              {},
              make("header.panel-title", {}, make("h3", {}, "Scope"), this.scope.caption),
              this.scope.element,
            ),
      ),
      this.readings,
      this.bar.element,
    );
    const frames = makeFrameMap(description.wrist_from_patient);
    this.theatre = new Theatre(place, scene, frames, faceNames(description.side));
    this.theatre.setInstruments(exercise.instruments);
    this.theatre.setDragLooks(true);
    this.showTruth(exercise.mode === "practice");
  }

  get shownTick(): number | undefined {
    return this.shown?.snapshot.tick;
  }

  get shownState(): ReplayState | undefined {
    return this.shown;
  }

  pagePoint(mm: readonly [number, number, number]): { readonly x: number; readonly y: number } {
    return this.theatre.pagePoint(mm);
  }

  /** Bones and ticks, or what eyes saw. */
  showTruth(on: boolean): void {
    this.theatre.showOnlySkin(!on);
    this.theatre.setSkin(on ? SHELL : 1);
  }

  lookFrom(view: ViewId): void {
    this.theatre.lookFrom(view);
  }

  invert(): void {
    this.inverted = !this.inverted;
    this.monitorShown = undefined;
    this.stripShown = "";
    this.showPictures();
  }

  /** What is to be seen at a moment; asks for what is not there. @return whether it is there */
  show(tick: number, speed: number, plays: boolean): boolean {
    this.position = tick;
    this.bar.show(tick);
    const at = Math.floor(tick);
    const wanted = this.failed ? undefined : this.buffer.wanted(at, speed, plays);
    if (wanted !== undefined && this.asking === undefined) {
      const asking = (this.asking = new AbortController());
      fetchStates(this.attempt.id, wanted, asking.signal)
        .then((states) => {
          this.buffer.add(wanted, states);
        })
        .catch((error: unknown) => {
          if (asking.signal.aborted) return;
          this.failed = true;
          setText(this.waiting, error instanceof Error ? error.message : String(error));
        })
        .finally(() => {
          this.asking = undefined;
        });
    }
    const state = this.buffer.at(at);
    const isThere = state !== undefined && (plays || state.snapshot.tick === at);
    if (!this.failed) setText(this.waiting, "");
    this.waiting.hidden = !this.failed;
    if (state !== undefined && state !== this.shown) this.take(state);
    this.showPictures();
    return isThere;
  }

  draw(): void {
    this.theatre.draw();
    this.scope?.draw();
  }

  dispose(): void {
    this.asking?.abort();
    this.scope?.dispose();
    this.theatre.dispose();
  }

  private take(state: ReplayState): void {
    const before = this.shown;
    this.shown = state;
    const { bodies } = this.exercise;
    state.bodies.forEach((pose, index) => {
      const body = bodies[index];
      if (body !== undefined) this.theatre.setBonePose(body.name, pose);
    });
    if (before?.tracks !== state.tracks) this.theatre.setTracks(state.tracks);
    if (before === undefined) {
      this.theatre.setTarget(bodies.filter((one) => one.is_target).map((one) => one.name));
    }
    this.theatre.show(state.snapshot);
    this.theatre.showSkinWork(state.skin);
    this.scope?.take(state);
    setText(this.readings, readingsOf(state.snapshot, this.exercise));
  }

  /** The last looks that were taken until now, oldest first [ticks]. */
  private lastLooks(): number[] {
    return this.looks.filter((tick) => tick <= this.position).slice(-STRIP);
  }

  private showPictures(): void {
    const s = this.shown?.snapshot;
    const looks = this.lastLooks();
    const isLive = s?.c_arm.live === true;
    const liveTick = isLive ? s.tick - (s.tick % PULSE_TICKS) : undefined;
    const wishes = [liveTick, ...[...looks].reverse()].filter((tick) => tick !== undefined);
    this.ask(wishes.find((tick) => !this.pictures.has(tick)));
    const live = liveTick === undefined ? undefined : this.newestLive(liveTick);
    const picture = live ?? this.newestOf(looks);
    const isMade = looks.length > 0 || isLive;
    this.monitor.sayWhileEmpty(isMade ? "Making the picture…" : "No picture was taken yet.");
    if (picture !== this.monitorShown) {
      this.monitorShown = picture;
      const view = picture === undefined ? "" : this.nameOf(picture);
      this.monitor.show({
        picture,
        inverted: this.inverted,
        overlay: { view },
      });
      const number = picture?.kind === "live" ? "live" : `shot ${picture?.shot ?? 0}`;
      setText(this.pictureName, picture === undefined ? "" : `${view}, ${number}`);
    }
    this.drawStrip(looks);
  }

  private nameOf(picture: CArmPicture): string {
    return viewName(this.exercise.views, picture.rotationDeg, picture.tiltDeg);
  }

  private newestOf(looks: readonly number[]): CArmPicture | undefined {
    const tick = looks.at(-1);
    return tick === undefined ? undefined : this.pictures.get(tick);
  }

  /** Of this live look, the newest that has come. */
  private newestLive(tick: number): CArmPicture | undefined {
    for (let at = tick; at > tick - 20 * PULSE_TICKS; at -= PULSE_TICKS) {
      const picture = this.pictures.get(at);
      if (picture?.kind === "live") return picture;
    }
    return undefined;
  }

  /** One at a time, the newest wish first. */
  private ask(tick: number | undefined): void {
    if (tick === undefined || this.pictureAsked !== undefined) return;
    this.pictureAsked = tick;
    fetchReplayPicture(this.attempt.id, tick)
      .then((picture) => {
        this.pictures.set(tick, picture);
        const oldest = this.pictures.keys().next().value;
        if (this.pictures.size > PICTURES_KEPT && oldest !== undefined) {
          this.pictures.delete(oldest);
        }
        this.pictureAsked = undefined;
      })
      .catch((error: unknown) => {
        // Asked again only when one comes back to it: it stays asked for until another moment.
        this.handlers.say(error instanceof Error ? error.message : String(error));
        setTimeout(() => {
          this.pictureAsked = undefined;
        }, 2000);
      });
  }

  private drawStrip(looks: readonly number[]): void {
    const there = looks.filter((tick) => this.pictures.has(tick));
    const key = `${this.inverted} ${there.join()}`;
    if (key === this.stripShown) return;
    this.stripShown = key;
    this.strip.replaceChildren(
      ...there.map((tick) => {
        const picture = this.pictures.get(tick);
        const small = make("canvas", { width: "128", height: "128", "aria-hidden": "true" });
        drawPicture(small, picture, this.inverted, undefined);
        const name = picture === undefined ? "" : this.nameOf(picture);
        const b = make(
          "button.quiet",
          { type: "button", "aria-label": `Go to shot ${picture?.shot ?? 0}, ${name}` },
          small,
          make("span", {}, name),
        );
        b.addEventListener("click", () => {
          this.handlers.moved(tick);
        });
        return b;
      }),
    );
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The room Train: joins link, theatre, hand, C-arm and bars. The host owns the truth; this shows it.
import { CArmPanel } from "../c_arm";
import type { Screw } from "../case_data";
import { make, setText } from "../dom";
import { faceNames, makeFrameMap } from "../frames";
import { HelpOverlay } from "../help_overlay";
import { HostLink, openPageSocket, pageWord, type LinkState } from "../host_link";
import { whyStuck } from "../operation";
import {
  parseViews,
  type CaseDescription,
  type HostMessage,
  type PageMessage,
  type SnapshotMessage,
  type Vec3,
} from "../protocol";
import { StartDialog, type StartChoice } from "../start_dialog";
import { Theatre, type CaseScene } from "../theatre";
import { Actions, toggleFullScreen } from "./actions";
import { BottomBar } from "./bottom_bar";
import { ConfirmDialog } from "./confirm_dialog";
import { Hand } from "./hand";
import { listenToKeys } from "./keys";
import { Notice } from "./notice";
import { Participation } from "./participation_model";
import { ScrewList } from "./screw_list";
import { StepPanel } from "./step_panel";
import { TopBar } from "./top_bar";
import "./train.css";
import { ViewBar } from "./view_bar";
import { waitingText, type WaitingOperation } from "./waiting_model";

/** Readings are for eyes: ten times a second is enough. */
const READINGS_MS = 100;
/** At most this often the hand is sent [1/s]. */
const SEND_PER_S = 60;

/** In the renderer: from dorsal, a little from proximal, as the driver is brought to a flexed wrist. */
const START_SHAFT: Vec3 = [0, -0.26, 0.97];

declare global {
  interface Window {
    /** For tests and screenshots: what is shown, never a way to act. */
    carpus?: {
      snapshot(): SnapshotMessage | undefined;
      pagePoint(mm: Vec3): { readonly x: number; readonly y: number };
      screenAxes(): { readonly right: Vec3; readonly up: Vec3 };
    };
  }
}

export class TrainPage {
  private readonly theatre: Theatre;
  private readonly hand: Hand;
  private readonly link: HostLink;
  private readonly arm: CArmPanel;
  private readonly top: TopBar;
  private readonly bottom: BottomBar;
  private readonly steps = new StepPanel();
  private readonly start: StartDialog;
  private readonly help = new HelpOverlay();
  private readonly tray: ScrewList;
  private readonly views: ViewBar;
  private readonly finishQuestion: ConfirmDialog;
  private readonly anewQuestion: ConfirmDialog;
  private readonly notice = new Notice();
  private readonly frozen = make("p.frozen", { role: "alert" });
  private readonly pausedSign = make(
    "p.paused",
    { role: "status" },
    make("strong", {}, "Paused"),
    "time stands still; ",
    make("kbd", {}, "P"),
    " goes on",
  );
  private readonly actions: Actions;
  private readonly abort = new AbortController();
  private latest: SnapshotMessage | undefined;
  private readonly part = new Participation();
  private pausedByHand = false;
  private waiting: WaitingOperation = { trainee: "", startedAt: "" };
  /** Said before what waits. */
  private waitingLead = "";
  private trainee = "";
  private wanted: StartChoice = { trainee: "" };
  private sequence = 0;
  private readonly readingsTimer: number;
  private frameRequest = 0;
  private lastSentMs = -Infinity;

  constructor(
    app: HTMLElement,
    description: CaseDescription,
    private readonly screws: readonly Screw[],
    scene: CaseScene,
  ) {
    this.top = new TopBar(description, {
      pause: () => {
        this.togglePause();
      },
      help: () => {
        this.help.toggle();
      },
      fullScreen: toggleFullScreen,
    });
    this.bottom = new BottomBar({
      measure: () => {
        this.actions.act({ kind: "measure" });
      },
      screws: () => {
        this.actions.act({ kind: "screws" });
      },
      undo: () => {
        this.actions.act({ kind: "undo" });
      },
      restart: () => {
        this.wanted = { trainee: this.trainee };
        this.anewQuestion.ask();
      },
      finish: () => {
        this.actions.act({ kind: "finish" });
      },
    });
    this.arm = new CArmPanel(parseViews(description.views), {
      takeShot: (rotationDeg, tiltDeg) => {
        this.tell({ type: "take_shot", rotation_deg: rotationDeg, tilt_deg: tiltDeg });
      },
    });
    this.start = new StartDialog(
      description,
      (choice) => {
        this.wanted = choice;
        if (this.part.isOffered) this.anewQuestion.ask();
        else this.begin(choice);
      },
      (choice) => {
        this.resume(choice);
      },
    );
    this.tray = new ScrewList(screws, (screw) => {
      this.tell({ type: "select_screw", index: screw.index });
    });
    this.finishQuestion = new ConfirmDialog(
      "Finish the operation?",
      "The placement is measured and stored. After this nothing can be changed.",
      "Finish and score",
      () => {
        this.tell({ type: "finish" });
      },
    );
    this.anewQuestion = new ConfirmDialog(
      "Start anew?",
      "What was done so far is stored as unfinished.",
      "Start anew",
      () => {
        this.begin(this.wanted);
      },
    );
    this.views = new ViewBar({
      look: (view) => {
        this.actions.look(view);
      },
      skin: (opacity) => {
        this.theatre.setSkin(opacity);
      },
      names: () => {
        this.actions.act({ kind: "labels" });
      },
    });
    const stage = make("div.stage", { role: "application", "aria-label": "Theatre, 3-D" });
    this.frozen.hidden = this.pausedSign.hidden = true;
    app.replaceChildren(
      make(
        "main.train",
        {},
        this.top.element,
        this.steps.element,
        make(
          "section.theatre",
          { "aria-label": "Theatre" },
          stage,
          this.frozen,
          this.pausedSign,
          this.views.element,
          this.notice.element,
        ),
        this.arm.element,
        this.bottom.element,
      ),
      this.start.element,
      this.help.element,
      this.tray.element,
      this.finishQuestion.element,
      this.anewQuestion.element,
    );
    const frames = makeFrameMap(description.held_wrist_from_patient);
    this.theatre = new Theatre(stage, scene, frames, faceNames(description.side));
    this.theatre.setSkin(this.views.skinOpacity);
    this.theatre.onViewLeft = () => {
      this.views.showView(undefined);
    };
    this.hand = new Hand(this.theatre, {
      send: (tool) => {
        this.sequence = (this.sequence + 1) % 0xffffffff;
        this.link.send({ type: "tool", sequence: this.sequence, ...tool });
      },
      say: (hint) => {
        this.say(hint);
      },
      snapshot: () => this.latest,
    });
    this.hand.reset(this.theatre.startPointMm(), frames.directionToPatient(...START_SHAFT));
    this.actions = new Actions({
      arm: this.arm,
      hand: this.hand,
      theatre: this.theatre,
      views: this.views,
      tray: this.tray,
      help: this.help,
      latest: () => this.latest,
      tell: (message) => {
        this.tell(message);
      },
      say: (text) => {
        this.say(text);
      },
      finish: () => {
        if (this.part.operates) this.finishQuestion.ask();
      },
      pause: () => {
        this.togglePause();
      },
    });
    listenToKeys(
      {
        hand: this.hand,
        canvas: this.theatre.canvas,
        act: (action) => {
          this.actions.act(action);
        },
        closeHelp: () => {
          const { open } = this.help.element;
          if (open) this.help.toggle();
          return open;
        },
      },
      this.abort.signal,
    );
    this.start.setReady(false, "Connecting to the host…");
    this.start.open();
    this.link = new HostLink(openPageSocket, pageWord(), {
      onState: (state, why) => {
        this.linkState(state, why);
      },
      onMessage: (message) => {
        this.receive(message);
      },
      onPicture: (picture) => {
        this.arm.add(picture);
      },
      onRefused: (reason) => {
        this.say(`Passed over a message that is none: ${reason}`);
      },
    });
    window.carpus = {
      snapshot: () => this.latest,
      pagePoint: (mm) => this.theatre.pagePoint(mm),
      screenAxes: () => this.theatre.screenAxes(),
    };
    this.readingsTimer = window.setInterval(() => {
      this.showReadings();
    }, READINGS_MS);
    const loop = (nowMs: number): void => {
      this.frameRequest = requestAnimationFrame(loop);
      this.frame(nowMs);
    };
    this.frameRequest = requestAnimationFrame(loop);
  }

  dispose(): void {
    cancelAnimationFrame(this.frameRequest);
    clearInterval(this.readingsTimer);
    this.notice.dispose();
    this.abort.abort();
    delete window.carpus;
    this.link.dispose();
    this.hand.dispose();
    this.theatre.dispose();
  }

  private frame(nowMs: number): void {
    if (nowMs - this.lastSentMs >= 1000 / SEND_PER_S - 1) {
      this.lastSentMs = nowMs;
      this.hand.frame(performance.now());
    }
    this.theatre.draw();
  }

  private begin(choice: StartChoice): void {
    this.trainee = choice.trainee;
    const sent = this.link.send({
      type: "start",
      trainee: choice.trainee,
      procedure: "dorsal_scaphoid_fixation",
      input_device: "mouse",
      seed: crypto.getRandomValues(new Uint32Array(1))[0] ?? 1,
    });
    if (!sent) return;
    this.part.ask();
    this.pausedByHand = false;
    this.forget();
    this.say("Press ? for mouse and keys.");
    this.enter();
  }

  private resume(choice: StartChoice): void {
    this.trainee = choice.trainee;
    this.part.goOn();
    this.pausedByHand = false;
    if (this.latest !== undefined) this.hand.takeOver(this.latest);
    this.goOn();
    this.enter();
  }

  /** The page operates from now on. */
  private enter(): void {
    this.start.offerResume(false);
    this.start.close();
    this.hand.setEnabled(true);
    this.theatre.canvas.focus({ preventScroll: true });
  }

  /** The page does not operate any more; `note` says why. */
  private leave(note: string): void {
    this.hand.setEnabled(false);
    this.frozen.hidden = this.pausedSign.hidden = true;
    for (const { element } of [this.finishQuestion, this.anewQuestion, this.tray, this.help])
      element.close();
    this.start.offerResume(this.part.isOffered);
    this.start.setReady(true, note);
    this.start.open();
  }

  /** Another exercise waits that this page may go on with. */
  private offer(lead: string): void {
    this.forget();
    this.latest = undefined;
    this.waitingLead = lead;
    this.leave(lead + waitingText(this.waiting, undefined, new Date()));
  }

  /** What was seen of an exercise that is over. */
  private forget(): void {
    this.steps.clearLog();
    this.arm.clear();
  }

  /** The host lets time pass again, unless the trainee had stopped it. */
  private goOn(): void {
    this.tell({ type: "pause", on: this.pausedByHand });
  }

  private togglePause(): void {
    if (this.latest === undefined || !this.part.operates) return;
    this.pausedByHand = !this.latest.paused;
    this.tell({ type: "pause", on: this.pausedByHand });
  }

  private tell(message: PageMessage): void {
    if (!this.link.send(message))
      this.say("Not connected: nothing was sent. Wait for the connection.");
  }

  private linkState(state: LinkState, why: string): void {
    const open = state === "open";
    const text =
      state === "busy"
        ? `${why === "" ? "Another page operates here." : why} This page asks again by itself.`
        : state === "lost"
          ? "The connection is lost; the scene is frozen. Trying again by itself…"
          : "";
    if (!open) {
      this.part.lose();
      this.start.offerResume(false);
    }
    this.frozen.hidden = open || !this.part.operates;
    setText(this.frozen, text);
    this.top.showLink(state === "lost" ? "not connected" : state === "busy" ? "busy" : "");
    this.start.setReady(open, open ? "" : text);
    this.hand.setEnabled(open && this.part.operates);
  }

  private receive(message: HostMessage): void {
    switch (message.type) {
      case "snapshot":
        this.takeSnapshot(message);
        break;
      case "event":
        this.steps.addLog(message.tick, message.text);
        break;
      case "score":
        this.part.finish();
        location.hash = `#/attempts/${message.attempt_id}`;
        break;
      case "error":
        this.say(
          message.what_to_do === "" ? message.reason : `${message.reason} ${message.what_to_do}`,
        );
        break;
      case "welcome":
        this.waiting = { trainee: message.trainee, startedAt: message.started_at };
        this.arrive(message.exercise);
        break;
      case "busy":
        break;
    }
  }

  /** The host takes this page, for the first time or again, or has begun what it asked for. */
  private arrive(exercise: number): void {
    const arrival = this.part.arrive(exercise);
    switch (arrival) {
      case "begun":
        // Pictures of the exercise before may have come after the request.
        this.forget();
        break;
      case "goes_on":
        // The host tells the log again.
        this.steps.clearLog();
        this.goOn();
        this.say("Connected again: the operation goes on where it was.");
        break;
      case "ended":
        this.leave("The operation has ended; it is among the past attempts.");
        break;
      case "replaced":
        this.offer("Your operation has ended; it is among the past attempts. ");
        break;
      case "offered":
        this.offer("");
        break;
      case "free":
        this.leave("");
        break;
    }
  }

  private takeSnapshot(s: SnapshotMessage): void {
    const screw = this.screws.find((one) => one.index === s.screw_index);
    if (screw !== undefined && s.screw_index !== this.latest?.screw_index)
      this.theatre.setScrewShape(screw);
    this.latest = s;
    if (this.part.isOffered && !this.part.operates)
      this.start.setReady(true, this.waitingLead + waitingText(this.waiting, s, new Date()));
    this.theatre.show(s);
    this.bottom.sample(s);
    this.steps.show(s);
  }

  private showReadings(): void {
    const s = this.latest;
    if (s === undefined) return;
    this.top.showTiming(s);
    this.pausedSign.hidden = !s.paused || !this.part.operates || !this.frozen.hidden;
    this.bottom.show(s, this.hand.driver, this.hand.thrust);
    this.arm.showCount(s.shots, s.dose_cgy_cm2);
    // Where frames are slow or the page is hidden, the host still has to hear of the hand.
    this.hand.frame(performance.now());
    const stuck = this.hand.driver === "forward" ? whyStuck(s, this.hand.thrust) : undefined;
    if (stuck !== undefined) this.say(stuck);
  }

  private say(text: string): void {
    this.notice.say(text);
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A card at the theatre's edge that has the person do each thing once. It comes with the first operation on
// this device, can be left at once, and begins again from the help.
import { button, make, remember, remembered, setText } from "../dom";
import { keyCap } from "../key_caps";
import "./first_touch.css";
import { FirstTouch, TASKS, type Observation, type Task } from "./first_touch_model";

const KEY = "carpus.first_touch";

interface Told {
  readonly name: string;
  readonly mouse: string;
  readonly finger: string;
  readonly keys: string;
  readonly gamepad: string;
}

const TOLD: Readonly<Record<Task, Told>> = {
  look: {
    name: "Turn the view",
    mouse: "Drag with the right button.",
    finger: "Drag with two fingers.",
    keys: "Ctrl + arrows",
    gamepad: "The cross turns it; the right stick pressed goes to the next view.",
  },
  move: {
    name: "Move the tip",
    mouse: "Drag it onto a bone with the left button.",
    finger: "Drag with one finger: it pushes the tip along.",
    keys: "Arrows, {KeyA} {KeyD}",
    gamepad: "The left stick; RB brings it nearer, LB back.",
  },
  aim: {
    name: "Aim",
    mouse: "Shift + drag turns the shaft, or look along the way and press Enter.",
    finger: "Choose Shaft below and drag, or look along the way and touch Aim.",
    keys: "Shift + arrows, Enter",
    gamepad: "The right stick, or look along the way and press B.",
  },
  drive: {
    name: "Push and drive",
    mouse: "With the tip on bone hold Drive. Less push where bone is soft.",
    finger: "With the tip on bone hold Drive. Less push where bone is soft.",
    keys: "hold Space, {BracketLeft} {BracketRight}",
    gamepad: "With the tip on bone: the right trigger, as deep as you push.",
  },
  shot: {
    name: "Take a picture",
    mouse: "Choose a view of the C-arm.",
    finger: "Touch a view of the C-arm.",
    keys: "1 … 6, hold {KeyE}",
    gamepad: "A; Y takes the next view, X held looks live.",
  },
  undo: {
    name: "Undo",
    mouse: "Back to before the bone was entered.",
    finger: "Back to before the bone was entered.",
    keys: "{KeyZ}",
    gamepad: "Back.",
  },
};

export class FirstTouchCard {
  readonly element: HTMLElement;
  private readonly list = make("ol");
  private readonly rows: ReadonlyMap<Task, HTMLElement>;
  private readonly end = make("p", { role: "status" });
  private readonly leaveButton: HTMLButtonElement;
  private readonly anewButton: HTMLButtonElement;
  private touch: FirstTouch | undefined;
  private beganMs = 0;
  private readonly byFinger = window.matchMedia("(pointer: coarse)").matches;
  private readonly ways = new Map<Task, HTMLElement>();

  /** @param startAnew  asks, then begins an operation in earnest */
  constructor(startAnew: () => void) {
    this.rows = new Map(
      TASKS.map((task) => {
        const way = make("p");
        this.ways.set(task, way);
        const row = make("li", {}, make("span.first-touch-name", {}, TOLD[task].name), way);
        return [task, row];
      }),
    );
    this.list.append(...this.rows.values());
    this.leaveButton = button(
      "Skip",
      "",
      () => {
        this.leave();
      },
      ".quiet",
    );
    this.anewButton = button("Start anew", "", () => {
      this.leave();
      startAnew();
    });
    this.element = make(
      "section.first-touch",
      { "aria-label": "First touch" },
      make("header.panel-title", {}, make("h2", {}, "First touch"), this.leaveButton),
      this.list,
      this.end,
      this.anewButton,
    );
    this.element.hidden = true;
    this.useGamepad(false);
  }

  /** Says how by gamepad, while one is plugged in. */
  useGamepad(on: boolean): void {
    for (const [task, way] of this.ways) {
      const { finger, gamepad, keys, mouse } = TOLD[task];
      if (on) way.replaceChildren(gamepad);
      else way.replaceChildren(this.byFinger ? finger : mouse, " ", keyCap(keys));
    }
  }

  /** With the first operation on this device. */
  offer(): void {
    if (remembered(KEY) === "") this.begin();
  }

  begin(): void {
    this.touch = new FirstTouch();
    this.beganMs = performance.now();
    this.element.hidden = false;
    this.show();
  }

  observe(now: Observation): void {
    if (this.touch === undefined || this.touch.finished) return;
    if (this.touch.observe(now)) this.show();
  }

  private leave(): void {
    remember(KEY, "seen");
    this.touch = undefined;
    this.element.hidden = true;
  }

  private show(): void {
    const { touch } = this;
    if (touch === undefined) return;
    for (const [task, row] of this.rows) {
      row.classList.toggle("done", touch.isDone(task));
      row.classList.toggle("current", task === touch.current);
    }
    const { finished } = touch;
    if (finished) remember(KEY, "seen");
    const seconds = Math.round((performance.now() - this.beganMs) / 1000);
    setText(
      this.end,
      finished ? `All of it in ${seconds} s. This bone is drilled: start anew.` : "",
    );
    setText(this.leaveButton, finished ? "Go on" : "Skip");
    this.anewButton.hidden = !finished;
    this.element.classList.toggle("finished", finished);
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A card at the theatre's edge that has the person do each thing once. It comes with the first operation of
// its kind on this device, can be left at once, and begins again from the help.
import { button, make, remember, remembered, setText } from "../dom";
import { keyCap } from "../key_caps";
import "./first_touch.css";
import { FirstTouch, type Lesson, type Observation } from "./first_touch_model";

interface Row {
  readonly element: HTMLElement;
  readonly way: HTMLElement;
}

export class FirstTouchCard {
  readonly element: HTMLElement;
  private readonly list = make("ol");
  private readonly rows = new Map<string, Row>();
  private readonly end = make("p", { role: "status" });
  private readonly leaveButton: HTMLButtonElement;
  private readonly anewButton: HTMLButtonElement;
  private lesson: Lesson | undefined;
  private touch: FirstTouch | undefined;
  private beganMs = 0;
  private hasGamepad = false;
  private readonly byFinger = window.matchMedia("(pointer: coarse)").matches;

  /** @param startAnew  asks, then begins an operation in earnest */
  constructor(startAnew: () => void) {
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
  }

  /** Says how by gamepad, while one is plugged in. */
  useGamepad(on: boolean): void {
    this.hasGamepad = on;
    for (const task of this.lesson?.tasks ?? []) {
      const way = this.rows.get(task.id)?.way;
      if (on) way?.replaceChildren(task.gamepad);
      else way?.replaceChildren(this.byFinger ? task.finger : task.mouse, " ", keyCap(task.keys));
    }
  }

  /** That of the operation that runs; undefined where there is none. */
  useLesson(lesson: Lesson | undefined): void {
    if (lesson === this.lesson) return;
    this.lesson = lesson;
    this.touch = undefined;
    this.element.hidden = true;
    this.rows.clear();
    for (const { id, name } of lesson?.tasks ?? []) {
      const way = make("p");
      this.rows.set(id, {
        element: make("li", {}, make("span.first-touch-name", {}, name), way),
        way,
      });
    }
    this.list.replaceChildren(...[...this.rows.values()].map(({ element }) => element));
    this.useGamepad(this.hasGamepad);
  }

  /** With the first operation of its kind on this device. */
  offer(): void {
    if (this.lesson !== undefined && remembered(this.lesson.id) === "") this.begin();
  }

  begin(): void {
    if (this.lesson === undefined) return;
    this.touch = new FirstTouch(this.lesson);
    this.beganMs = performance.now();
    this.element.hidden = false;
    this.show();
  }

  observe(now: Observation): void {
    if (this.touch === undefined || this.touch.finished) return;
    if (this.touch.observe(now)) this.show();
  }

  private leave(): void {
    this.rememberIt();
    this.touch = undefined;
    this.element.hidden = true;
  }

  private rememberIt(): void {
    if (this.lesson !== undefined) remember(this.lesson.id, "seen");
  }

  private show(): void {
    const { touch } = this;
    if (touch === undefined) return;
    for (const [task, { element }] of this.rows) {
      element.classList.toggle("done", touch.isDone(task));
      element.classList.toggle("current", task === touch.current);
    }
    const { finished } = touch;
    if (finished) this.rememberIt();
    const seconds = Math.round((performance.now() - this.beganMs) / 1000);
    const { spoils } = touch.lesson;
    const all = `All of it in ${seconds} s.${spoils ? " This bone is drilled: start anew." : ""}`;
    setText(this.end, finished ? all : "");
    setText(this.leaveButton, finished ? "Go on" : "Skip");
    this.anewButton.hidden = !finished || !spoils;
    this.element.classList.toggle("finished", finished);
  }
}

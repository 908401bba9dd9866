// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The C-arm's foot pedal: down while its key or its button is held, by whichever; said again and again,
// since the host lets go of what it does not hear of.
import { make, whileHeld } from "../dom";
import { keyCap, nameShortcut } from "../key_caps";

/** The host lets go after 2 s. */
const REPEAT_MS = 100;

export interface PedalHandlers {
  /** Why it cannot be pressed now, if it cannot. */
  whyNot(): string | undefined;
  send(down: boolean): void;
  say(text: string): void;
}

export class Pedal {
  readonly button: HTMLButtonElement;
  /** What holds it down: codes of keys, holders of its button. */
  private readonly holders = new Set<string>();
  private timer: ReturnType<typeof setInterval> | undefined;

  constructor(private readonly handlers: PedalHandlers) {
    this.button = make(
      "button.c-arm-pedal",
      { type: "button", "aria-pressed": "false", title: "Hold for live pictures" },
      "Live",
      keyCap("hold {KeyE}"),
    );
    nameShortcut(this.button, "{KeyE}");
    whileHeld(
      this.button,
      (holder) => {
        this.press(holder);
      },
      (holder) => {
        this.release(holder);
      },
    );
    window.addEventListener("blur", () => {
      this.releaseAll();
    });
  }

  get isDown(): boolean {
    return this.holders.size > 0;
  }

  press(holder: string): void {
    const why = this.handlers.whyNot();
    if (why !== undefined) {
      this.handlers.say(why);
      return;
    }
    this.holders.add(holder);
    this.tell();
  }

  release(holder: string): void {
    if (this.holders.delete(holder)) this.tell();
  }

  releaseAll(): void {
    if (!this.isDown) return;
    this.holders.clear();
    this.tell();
  }

  private tell(): void {
    this.button.setAttribute("aria-pressed", String(this.isDown));
    this.handlers.send(this.isDown);
    clearInterval(this.timer);
    if (!this.isDown) return;
    this.timer = setInterval(() => {
      this.handlers.send(true);
    }, REPEAT_MS);
  }
}

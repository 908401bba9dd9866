// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The help: the table of keys, as a dialog over the theatre.
import { button, make } from "../dom";
import { keyCap } from "../key_caps";
import { GAMEPAD_HELP, HELP, TOUCH_HELP } from "../operation";
import "./help_overlay.css";

export class HelpOverlay {
  readonly element: HTMLDialogElement;

  private readonly firstTouch: HTMLButtonElement;

  /** @param firstTouch  begins it */
  constructor(firstTouch: () => void) {
    const close = button("Close", "Esc", () => {
      this.element.close();
    });
    close.autofocus = true;
    this.firstTouch = button("First touch, 90 seconds", "", () => {
      this.element.close();
      firstTouch();
    });
    this.element = make(
      "dialog.help",
      { "aria-labelledby": "help-title" },
      make(
        "div",
        {},
        make(
          "header",
          {},
          make("h2", { id: "help-title" }, "Mouse, keys, touch, gamepad"),
          make("span.help-ways", {}, this.firstTouch, close),
        ),
        make(
          "p.secondary",
          {},
          "Shift turns what plain keys move. A tap is one step, holding goes on and gets faster. ",
          "Keys are named as your keyboard prints them.",
        ),
        make(
          "div.help-groups",
          {},
          ...[...HELP, TOUCH_HELP, GAMEPAD_HELP].map((group) =>
            make(
              "section",
              {},
              make("h3", {}, group.title),
              make(
                "dl",
                {},
                ...group.lines.flatMap((line) => [
                  make("dt", {}, keyCap(line.keys)),
                  make("dd", {}, line.text),
                ]),
              ),
            ),
          ),
        ),
      ),
    );
    this.element.addEventListener("close", () => {
      this.onOpen?.(false);
    });
  }

  /** Whether it is read from now on. */
  onOpen: ((isOpen: boolean) => void) | undefined;

  /** Whether this operation has one. */
  offerFirstTouch(hasOne: boolean): void {
    this.firstTouch.hidden = !hasOne;
  }

  toggle(): void {
    if (this.element.open) this.element.close();
    else {
      this.element.showModal();
      this.onOpen?.(true);
    }
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The help: the table of keys, as a dialog over the theatre.
import { button, make } from "../dom";
import { keyCap } from "../key_caps";
import { HELP } from "../operation";
import "./help_overlay.css";

export class HelpOverlay {
  readonly element: HTMLDialogElement;

  constructor() {
    const close = button("Close", "Esc", () => {
      this.element.close();
    });
    this.element = make(
      "dialog.help",
      { "aria-labelledby": "help-title" },
      make(
        "div",
        {},
        make("header", {}, make("h2", { id: "help-title" }, "Mouse and keys"), close),
        make(
          "p.secondary",
          {},
          "Shift turns what plain keys move. A tap is one fine step, holding goes on and gets faster. ",
          "Coarse by mouse, fine by keys.",
        ),
        make(
          "div.help-groups",
          {},
          ...HELP.map((group) =>
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
  }

  toggle(): void {
    if (this.element.open) this.element.close();
    else this.element.showModal();
  }
}

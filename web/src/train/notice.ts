// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One line for what just happened; it goes by itself.
import { make, setText } from "../dom";
import { withKeys } from "../key_caps";

const SHOWN_MS = 9000;

export class Notice {
  readonly element = make("p.notice", { role: "status" });
  private timer = 0;

  say(text: string): void {
    setText(this.element, withKeys(text));
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      setText(this.element, "");
    }, SHOWN_MS);
  }

  dispose(): void {
    clearTimeout(this.timer);
  }
}

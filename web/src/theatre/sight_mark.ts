// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A thin cross in the middle of the picture while it is turned by keys: where "aim as seen" would lay the
// tip. It goes by itself.
import { make } from "../dom";

const SHOWN_MS = 2500;

export class SightMark {
  readonly element = make("div.sight-mark", { "aria-hidden": "true" });
  private timer = 0;

  constructor() {
    this.element.hidden = true;
  }

  show(): void {
    this.element.hidden = false;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      this.element.hidden = true;
    }, SHOWN_MS);
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.element.remove();
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The course of an attempt, for whoever goes through it afterwards.
import { make } from "../dom";
import { tickText } from "../operation";
import type { AttemptEvent } from "./events_model";

export function eventList(events: readonly AttemptEvent[]): HTMLElement {
  return make(
    "section.events",
    { "aria-labelledby": "events-title" },
    make("h2", { id: "events-title" }, "What happened"),
    events.length === 0
      ? make("p.secondary", {}, "Nothing was recorded.")
      : make(
          "ol",
          {},
          ...events.map(({ tickMs, text }) =>
            make("li", {}, make("time", {}, tickText(tickMs)), text),
          ),
        ),
  );
}

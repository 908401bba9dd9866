// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The course of an attempt, for whoever goes through it afterwards.
import { make } from "../dom";
import { tickText } from "../operation";
import type { LoggedEvent } from "../protocol";
import { runsOf } from "./event_runs_model";

/** @param events  null where the log cannot be read */
export function eventList(events: readonly LoggedEvent[] | null): HTMLElement {
  return make(
    "section.events",
    { "aria-labelledby": "events-title" },
    make("h2", { id: "events-title" }, "What happened"),
    events === null || events.length === 0
      ? make(
          "p.secondary",
          {},
          events === null ? "The log cannot be read." : "Nothing was recorded.",
        )
      : make(
          "ol",
          {},
          ...runsOf(events).map(({ tick, text, times }) =>
            make(
              "li",
              {},
              make("time", {}, tickText(tick)),
              times === 1 ? text : `${text}, ${times} times`,
            ),
          ),
        ),
  );
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the panels of the room stand in the page; order is the order of Tab.
import { make } from "../dom";
import type { Panels } from "./panels";
import "./stage.css";

/** Fills `app` with the room. @return the place of the 3-D view */
export function layOut(app: HTMLElement, panels: Panels): HTMLElement {
  const stage = make("div.stage", { role: "application", "aria-label": "Theatre, 3-D" });
  app.replaceChildren(
    make(
      "main.train",
      {},
      panels.top.element,
      panels.steps.element,
      make(
        "section.theatre",
        { "aria-label": "Theatre" },
        stage,
        panels.frozen,
        panels.pausedSign,
        panels.drive.element,
        panels.views.element,
        panels.notice.element,
      ),
      panels.arm.element,
      panels.bottom.element,
    ),
    panels.start.element,
    panels.help.element,
    panels.devices.element,
    panels.tray.element,
    panels.finishQuestion.element,
    panels.declineQuestion.element,
    panels.anewQuestion.element,
    panels.returnQuestion.element,
    panels.endQuestion.element,
  );
  return stage;
}

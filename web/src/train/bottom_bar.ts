// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the hand holds and feels, and the ways back and out.
import { button, make, setText } from "../dom";
import type { SnapshotMessage } from "../protocol";
import { Sparkline } from "./sparkline";

export interface BottomBarHandlers {
  measure(): void;
  screws(): void;
  undo(): void;
  restart(): void;
  finish(): void;
}

const HAND: Readonly<Record<SnapshotMessage["instrument"], string>> = {
  guide_wire: "Guide wire 1.14 mm",
  screw_driver: "Screw driver",
  none: "No instrument",
};

/** Length of the force on the hand [N]. */
export function forceN(s: SnapshotMessage): number {
  return Math.hypot(...s.force_n);
}

export class BottomBar {
  readonly element: HTMLElement;
  private readonly instrument = make("strong");
  private readonly driver = make("span");
  private readonly depth = make("span");
  private readonly measured = make("span");
  private readonly force = make("span");
  private readonly sparkline = new Sparkline();

  constructor(handlers: BottomBarHandlers) {
    this.element = make(
      "footer.bottom-bar",
      { "aria-label": "Instrument" },
      make(
        "div.readings",
        {},
        this.instrument,
        this.driver,
        this.depth,
        this.measured,
        this.force,
        this.sparkline.canvas,
      ),
      make(
        "div.ways",
        {},
        button("Measure", "M", handlers.measure, ".quiet"),
        button("Screw", "C", handlers.screws, ".quiet"),
        button("Undo", "Z", handlers.undo, ".quiet"),
        button("Restart", "", handlers.restart, ".quiet"),
        button("Finish", "F", handlers.finish),
      ),
    );
  }

  sample(s: SnapshotMessage): void {
    this.sparkline.push(forceN(s));
  }

  show(s: SnapshotMessage, driver: string, thrustN: number): void {
    const screw = s.screw_index >= 0;
    const alone = screw && s.instrument === "none";
    setText(
      this.instrument,
      screw ? `Screw ${s.screw_length_mm.toFixed(1)} mm` : HAND[s.instrument],
    );
    setText(this.driver, alone ? "driver and wire out" : `driver ${driver}, push ${thrustN} N`);
    this.driver.classList.toggle("running", driver !== "off");
    if (screw) {
      const out = s.screw_buried_mm < 0;
      const mm = Math.abs(s.screw_buried_mm).toFixed(1);
      setText(this.depth, out ? `tail stands out ${mm} mm` : `tail buried ${mm} mm`);
    } else {
      setText(this.depth, `depth ${s.wire_depth_mm.toFixed(1)} mm`);
    }
    setText(this.measured, s.measured_mm < 0 ? "" : `measured ${s.measured_mm.toFixed(1)} mm`);
    setText(this.force, `force ${forceN(s).toFixed(1)} N`);
    this.sparkline.draw();
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How hand and forearm are held: a small slider for each way, with its keys. The thumb of the slider is
// what is wished, the figure what the wrist has come to; how far it goes, the host says.
import { make, setText } from "../dom";
import { keyCap, withKeys } from "../key_caps";
import { WRIST_KEYS, type WristAxis } from "../operation";
import type { WristLimits, WristPose } from "../protocol";
import { nudged, readingText, REST, within } from "./wrist_model";
import "./wrist_panel.css";

const NAMES: Readonly<Record<WristAxis, readonly [name: string, more: string, less: string]>> = {
  flexion_deg: ["Flexion", "flex", "extend"],
  radial_deviation_deg: ["Deviation", "bend to the thumb", "bend to the little finger"],
  pronation_deg: ["Pronation", "pronate", "supinate"],
  traction_n: ["Traction", "pull more", "pull less"],
};

interface Row {
  readonly axis: WristAxis;
  readonly slider: HTMLInputElement;
  readonly reading: HTMLElement;
}

export class WristPanel {
  readonly element: HTMLElement;
  private readonly rows: readonly Row[];
  private wished: WristPose = REST;
  private limits: WristLimits | undefined;
  private isPlaced = false;

  constructor(private readonly send: (wish: WristPose) => void) {
    this.rows = (Object.keys(NAMES) as WristAxis[]).map((axis) => this.makeRow(axis));
    this.element = make(
      "section.wrist",
      { "aria-label": "Wrist" },
      make("h3", {}, "Wrist"),
      ...this.rows.map(({ axis, slider, reading }) => {
        const [name] = NAMES[axis];
        const [more, less] = WRIST_KEYS[axis].map((key) => keyCap(`{${key}}`));
        const label = make("label", { for: slider.id }, name);
        return make("div.wrist-row", {}, label, less ?? "", slider, more ?? "", reading);
      }),
    );
  }

  private makeRow(axis: WristAxis): Row {
    const [, more, less] = NAMES[axis];
    const slider = make("input", { type: "range", id: `wrist-${axis}`, step: "1" });
    const [moreKey, lessKey] = WRIST_KEYS[axis];
    slider.title = withKeys(`{${moreKey}}: ${more}; {${lessKey}}: ${less}`);
    slider.addEventListener("input", () => {
      if (this.limits !== undefined) this.wish({ ...this.wished, [axis]: Number(slider.value) });
    });
    return { axis, slider, reading: make("span.wrist-reading") };
  }

  /** Another exercise: how its wrist is held, its first snapshot will say. */
  reset(limits: WristLimits): void {
    this.limits = limits;
    this.isPlaced = false;
    for (const { axis, slider } of this.rows) {
      slider.min = String(limits[axis].low);
      slider.max = String(limits[axis].high);
    }
  }

  /** @param by  degrees or newtons */
  move(axis: WristAxis, by: number): void {
    if (this.limits !== undefined && this.isPlaced)
      this.wish(nudged(this.wished, this.limits, axis, by));
  }

  /** Within the limits, as a view wants it; the rest stays. */
  hold(wish: Partial<WristPose>): void {
    if (this.limits === undefined || !this.isPlaced) return;
    this.wish(within({ ...this.wished, ...wish }, this.limits));
  }

  show(now: WristPose): void {
    if (!this.isPlaced) {
      this.wished = now;
      this.isPlaced = true;
      this.showWish();
    }
    for (const { axis, reading } of this.rows) setText(reading, readingText(axis, now[axis]));
  }

  private wish(pose: WristPose): void {
    this.wished = pose;
    this.showWish();
    this.send(pose);
  }

  private showWish(): void {
    for (const { axis, slider } of this.rows) {
      slider.value = String(this.wished[axis]);
      slider.setAttribute("aria-valuetext", readingText(axis, this.wished[axis]));
    }
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The tray of screws. Choosing is the trainee's: nothing here says which one is right.
import { button, make } from "../dom";
import type { Screw } from "../protocol";

export class ScrewList {
  readonly element: HTMLDialogElement;
  private readonly list = make("div.screw-list", { role: "radiogroup", "aria-label": "Screws" });
  private readonly reading = make("p");
  private chosen: number | undefined;

  constructor(
    private readonly screws: readonly Screw[],
    private readonly onChoose: (screw: Screw) => void,
  ) {
    const form = make(
      "form",
      { method: "dialog" },
      make("h2", { id: "screws-title" }, "Choose a screw"),
      this.reading,
      this.list,
      make(
        "p.secondary",
        {},
        screws.some((screw) => !screw.confirmed)
          ? "Sizes not yet confirmed against the makers' guides: for training only."
          : "",
      ),
      make(
        "div.actions",
        {},
        button("Cancel", "Esc", () => {
          this.element.close();
        }),
        make("button.primary", { type: "submit" }, "Load on the driver", make("kbd", {}, "Enter")),
      ),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const screw = this.screws.find((s) => s.index === this.chosen);
      this.element.close();
      if (screw !== undefined) this.onChoose(screw);
    });
    form.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      form.requestSubmit();
    });
    this.element = make("dialog.screws", { "aria-labelledby": "screws-title" }, form);
  }

  open(current: number, measuredMm: number): void {
    this.chosen = current >= 0 ? current : this.screws[0]?.index;
    this.reading.textContent =
      measuredMm < 0
        ? "Not measured yet (M reads the gauge)."
        : `Measured ${measuredMm.toFixed(1)} mm.`;
    this.fill();
    this.element.showModal();
    this.list.querySelector<HTMLInputElement>("input:checked")?.focus();
  }

  /** The neighbour of `current` in the tray: with keys, without the list. */
  neighbour(current: number, by: number): Screw | undefined {
    const at = this.screws.findIndex((screw) => screw.index === current);
    if (at < 0) return this.screws[0];
    return this.screws[Math.min(this.screws.length - 1, Math.max(0, at + by))];
  }

  private fill(): void {
    this.list.replaceChildren(
      ...this.screws.map((screw) => {
        const input = make("input", { type: "radio", name: "screw", value: String(screw.index) });
        input.checked = screw.index === this.chosen;
        input.addEventListener("change", () => {
          this.chosen = screw.index;
        });
        const sizes = `tip ${screw.tip_diameter_mm.toFixed(1)}, tail ${screw.tail_diameter_mm.toFixed(1)} mm`;
        return make(
          "label",
          {},
          input,
          make("span.screw-name", {}, screw.name),
          make("span.secondary", {}, sizes),
        );
      }),
    );
  }
}

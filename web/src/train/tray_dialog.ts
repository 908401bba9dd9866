// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The tray: instruments and, by family, screws. Choosing is the trainee's: nothing here says which screw
// is right. What cannot be taken now stands there with the host's reason.
import { button, make, setText } from "../dom";
import { withKeys } from "../key_caps";
import type { HandIndex, OfferedActions } from "../operation";
import type { ExerciseMessage, Instrument } from "../protocol";
import { commonBeginning } from "./family_name_model";
import "./tray_dialog.css";

export interface TrayState {
  readonly offered: OfferedActions;
  readonly hand: HandIndex;
  /** Id of what that hand holds, or empty. */
  readonly held: string;
  /** Id of what the step is done with, or empty. */
  readonly wanted: string;
  readonly gaugeReadingMm: number | null;
}

export class TrayDialog {
  readonly element: HTMLDialogElement;
  private readonly groups = make("div.tray-groups");
  private readonly reading = make("p.secondary");
  private readonly unconfirmed = make("p.secondary");
  private tray: readonly Instrument[] = [];
  private hand: HandIndex = 0;

  constructor(onTake: (instrument: Instrument, hand: HandIndex) => void) {
    const form = make(
      "form",
      { method: "dialog" },
      make("h2", { id: "tray-title" }, "Take from the tray"),
      this.reading,
      this.groups,
      this.unconfirmed,
      make(
        "div.actions",
        {},
        button("Cancel", "Esc", () => {
          this.element.close();
        }),
        make("button.primary", { type: "submit" }, "Take", make("kbd", {}, "Enter")),
      ),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const checked = form.querySelector<HTMLInputElement>("input:checked");
      const instrument = this.tray.find((one) => one.id === checked?.value);
      if (instrument === undefined) return;
      this.element.close();
      onTake(instrument, this.hand);
    });
    form.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" || event.target instanceof HTMLButtonElement) return;
      event.preventDefault();
      form.requestSubmit();
    });
    this.element = make("dialog.tray", { "aria-labelledby": "tray-title" }, form);
  }

  setTray({ tray, instruments }: ExerciseMessage): void {
    this.tray = tray.flatMap((id) => instruments.find((one) => one.id === id) ?? []);
    setText(
      this.unconfirmed,
      this.tray.some((one) => !one.is_confirmed)
        ? "Sizes not yet confirmed against the makers' guides: for training only."
        : "",
    );
  }

  /** All of it, in the tray's order. */
  get instruments(): readonly Instrument[] {
    return this.tray;
  }

  open(state: TrayState): void {
    if (this.element.open) return;
    this.hand = state.hand;
    const { gaugeReadingMm } = state;
    setText(
      this.reading,
      gaugeReadingMm === null
        ? withKeys("The gauge was not read yet ({KeyM}).")
        : `The gauge reads ${gaugeReadingMm.toFixed(1)} mm.`,
    );
    this.fill(state);
    this.element.showModal();
    this.groups.querySelector<HTMLInputElement>("input:checked")?.focus();
  }

  /** The next shorter or longer screw of the family of `id`; the first screw where it is none. */
  neighbour(id: string, by: number): Instrument | undefined {
    const current = this.tray.find((one) => one.id === id);
    const screws = this.tray.filter((one) => one.family !== "");
    if (current === undefined || current.family === "") return screws[0];
    const family = screws
      .filter((one) => one.family === current.family)
      .sort((a, b) => a.length_mm - b.length_mm);
    const at = family.indexOf(current) + by;
    return family[Math.min(family.length - 1, Math.max(0, at))];
  }

  private fill(state: TrayState): void {
    const families = [...new Set(this.tray.map((one) => one.family))];
    const chosen = [state.wanted, state.held].find((id) => this.tray.some((one) => one.id === id));
    this.groups.replaceChildren(
      ...families.map((family) =>
        make(
          "fieldset",
          {},
          make("legend", {}, family === "" ? "Instruments" : this.familyName(family)),
          ...this.tray
            .filter((one) => one.family === family)
            .map((one) => this.row(one, state, one.id === (chosen ?? this.tray[0]?.id))),
        ),
      ),
    );
  }

  private familyName(family: string): string {
    return commonBeginning(this.tray.filter((one) => one.family === family).map((one) => one.name));
  }

  private row(one: Instrument, { offered, hand, held }: TrayState, isChosen: boolean): HTMLElement {
    const why = offered.whyNot({ id: "take", hand, instrument: one.id });
    const input = make("input", { type: "radio", name: "tray", value: one.id });
    input.checked = isChosen;
    input.disabled = why !== undefined;
    const sizes = `tip ${one.tip_diameter_mm.toFixed(1)}, tail ${one.tail_diameter_mm.toFixed(1)} mm`;
    const name = one.family === "" ? one.name : one.name.slice(this.familyName(one.family).length);
    const about = why ?? (one.family === "" ? one.use : sizes);
    return make(
      "label",
      {},
      input,
      make(
        "span.tray-name",
        {},
        one.id === held ? `${name}, in this hand` : name,
        make("span.secondary", {}, about),
      ),
    );
  }
}

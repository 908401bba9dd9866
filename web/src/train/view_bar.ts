// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Under the theatre: from where to look, how much skin, names.
import { button, make } from "../dom";
import { keyCap } from "../key_caps";
import { VIEWS, type ViewId } from "../theatre";

export interface ViewBarHandlers {
  look(view: ViewId): void;
  skin(opacity: number): void;
  names(): void;
}

const NAMES: Readonly<Record<ViewId, string>> = {
  dorsal: "Dorsal",
  radial: "Radial",
  volar: "Volar",
  ulnar: "Ulnar",
  wire: "Along shaft",
};

/** What `T` goes through [%]. */
const SKIN_STOPS = [20, 60, 100, 0];

export class ViewBar {
  readonly element: HTMLElement;
  private readonly looks: Readonly<Record<ViewId, HTMLButtonElement>>;
  private readonly slider: HTMLInputElement;
  private readonly namesButton: HTMLButtonElement;

  constructor(private readonly handlers: ViewBarHandlers) {
    const look = (view: ViewId): HTMLButtonElement =>
      button(
        NAMES[view],
        "",
        () => {
          handlers.look(view);
        },
        ".quiet",
      );
    this.looks = {
      dorsal: look("dorsal"),
      radial: look("radial"),
      volar: look("volar"),
      ulnar: look("ulnar"),
      wire: look("wire"),
    };
    this.slider = make("input", {
      type: "range",
      id: "skin-opacity",
      min: "0",
      max: "100",
      step: "5",
      value: String(SKIN_STOPS[0]),
    });
    this.slider.addEventListener("input", () => {
      handlers.skin(this.skinOpacity);
    });
    this.namesButton = button("Names", "{KeyL}", handlers.names, ".quiet");
    this.namesButton.setAttribute("aria-pressed", "false");
    this.element = make(
      "div.view-bar",
      { role: "group", "aria-label": "View" },
      make("span.secondary", {}, "View ", keyCap("{KeyV}")),
      ...VIEWS.map((view) => this.looks[view]),
      make("span.gap"),
      this.namesButton,
      make("label.secondary", { for: "skin-opacity" }, "Skin ", keyCap("{KeyT}")),
      this.slider,
    );
    this.showView("dorsal");
  }

  /** In an assessed operation nothing is seen through the skin. */
  showOnlySkin(on: boolean): void {
    this.element.classList.toggle("only-skin", on);
    this.namesButton.disabled = this.slider.disabled = on;
  }

  /** 0 to 1. */
  get skinOpacity(): number {
    return Number(this.slider.value) / 100;
  }

  nextSkin(): void {
    const at = SKIN_STOPS.indexOf(Number(this.slider.value));
    this.slider.value = String(SKIN_STOPS[(at + 1) % SKIN_STOPS.length] ?? 0);
    this.handlers.skin(this.skinOpacity);
  }

  /** @param shown  none once the view was turned or the wire moved */
  showView(shown: ViewId | undefined): void {
    for (const view of VIEWS) this.looks[view].setAttribute("aria-pressed", String(view === shown));
  }

  showNames(on: boolean): void {
    this.namesButton.setAttribute("aria-pressed", String(on));
  }
}

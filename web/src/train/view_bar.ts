// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Under the theatre: from where to look, how much skin, names.
import { button, make } from "../dom";
import { keyCap } from "../key_caps";
import { VIEWS, type Cut, type ViewId } from "../theatre";
import "./view_bar.css";

export interface ViewBarHandlers {
  look(view: ViewId): void;
  skin(opacity: number): void;
  names(): void;
  ghost(): void;
  cut(): void;
  hint(): void;
  structures(): void;
  appearance(): void;
}

const NAMES: Readonly<Record<ViewId, string>> = {
  dorsal: "Dorsal",
  radial: "Radial",
  volar: "Volar",
  ulnar: "Ulnar",
  wire: "Along shaft",
};

const CUT_NAMES: Readonly<Record<Cut, string>> = {
  off: "Cut",
  axis: "Cut: line",
  camera: "Cut: sight",
};

/** What `T` goes through [%]. */
const SKIN_STOPS = [20, 60, 100, 0];

export class ViewBar {
  readonly element: HTMLElement;
  private readonly looks: Readonly<Record<ViewId, HTMLButtonElement>>;
  private readonly slider: HTMLInputElement;
  private readonly namesButton: HTMLButtonElement;
  private readonly aids: Readonly<Record<"ghost" | "cut" | "hint", HTMLButtonElement>>;
  private readonly structuresButton: HTMLButtonElement;
  private readonly appearanceButton: HTMLButtonElement;
  private hasStructures = false;

  private readonly key = keyCap("{KeyV}");

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
    this.aids = {
      ghost: button("Ghost", "F2", handlers.ghost, ".quiet"),
      cut: button(CUT_NAMES.off, "F4", handlers.cut, ".quiet"),
      hint: button("Hint", "F8", handlers.hint, ".quiet"),
    };
    this.aids.ghost.title = "The planned line and screw";
    this.aids.cut.title = "Cuts the bones open: along the planned line, then across the sight";
    this.aids.hint.title = "What to change, in words";
    this.structuresButton = button("Tendons", "F7", handlers.structures, ".quiet");
    this.structuresButton.setAttribute("aria-pressed", "false");
    this.offerStructures(false);
    this.appearanceButton = button("Look", "", handlers.appearance, ".quiet");
    this.appearanceButton.title = "Appearance: materials, lamps, bitmaps, facets, hulls";
    this.appearanceButton.setAttribute("aria-expanded", "false");
    this.element = make(
      "div.view-bar",
      { role: "group", "aria-label": "View" },
      make("span.secondary", {}, make("span.view-word", {}, "View "), this.key),
      ...VIEWS.map((view) => this.looks[view]),
      make("span.gap"),
      make(
        "span.aids",
        { role: "group", "aria-label": "Aids, counted" },
        ...Object.values(this.aids),
      ),
      this.structuresButton,
      this.namesButton,
      this.appearanceButton,
      make("label.secondary", { for: "skin-opacity" }, "Skin ", keyCap("{KeyT}")),
      this.slider,
    );
    this.showView("dorsal");
  }

  /** In an assessed operation nothing is seen through the skin. */
  showOnlySkin(on: boolean): void {
    this.element.classList.toggle("only-skin", on);
    this.namesButton.disabled = this.slider.disabled = on;
    for (const aid of Object.values(this.aids)) aid.hidden = on;
    this.structuresButton.disabled = on || !this.hasStructures;
    if (on) this.showStructures(false);
  }

  /** In practice, where closed skin is worked on: what is asked for is shown on it. */
  showGhostOnSkin(): void {
    this.aids.ghost.hidden = false;
  }

  /** Where V does something else it is not named here. */
  offerKey(has: boolean): void {
    this.key.hidden = !has;
  }

  /** Where nothing is planned there is no ghost of it, and no cut along it. */
  offerPlan(has: boolean): void {
    this.aids.ghost.hidden = this.aids.cut.hidden = !has;
  }

  /** A case that was made before tendons, arteries and nerves were has none. */
  offerStructures(has: boolean): void {
    this.hasStructures = has;
    this.structuresButton.disabled = !has;
    this.structuresButton.title = has
      ? "Tendons, arteries and nerves: generated, not seen in the CT"
      : "This case has no tendons, arteries and nerves; make it again from its CT";
  }

  showStructures(on: boolean): void {
    this.structuresButton.setAttribute("aria-pressed", String(on));
  }

  showAppearance(isOpen: boolean): void {
    this.appearanceButton.setAttribute("aria-expanded", String(isOpen));
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

  showAids(ghost: boolean, cut: Cut): void {
    this.aids.ghost.setAttribute("aria-pressed", String(ghost));
    this.aids.cut.setAttribute("aria-pressed", String(cut !== "off"));
    const [label] = this.aids.cut.childNodes;
    if (label instanceof Text) label.data = CUT_NAMES[cut];
  }

  showNames(on: boolean): void {
    this.namesButton.setAttribute("aria-pressed", String(on));
  }
}

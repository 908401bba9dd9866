// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bar above a scan: windows, labels, measures, planes and the ways on; shows which of them are on.
import { button, make } from "../dom";
import type { MeasureKind } from "./measure_model";
import type { Alignment } from "./planes_model";
import type { GreyWindow } from "./slice_model";
import { WINDOWS } from "./window_model";

export interface ScanBarHandlers {
  setWindow(grey: GreyWindow): void;
  toggleLabels(): void;
  /** The opacity was moved: read it. */
  opacityChanged(): void;
  measure(kind: MeasureKind): void;
  turnPlanes(): void;
  /** Undefined where who looks may not. */
  readonly addScan: (() => void) | undefined;
  help(): void;
}

export interface ScanBarState {
  readonly grey: GreyWindow;
  readonly labelsShown: boolean;
  readonly measure: MeasureKind | undefined;
  readonly alignment: Alignment;
}

const FIRST_OPACITY = "25";

export class ScanBar {
  readonly element: HTMLElement;
  private readonly buttons = new Map<string, HTMLButtonElement>();
  private readonly slider = make("input", {
    type: "range",
    min: "0",
    max: "100",
    "aria-label": "Opacity of the labels",
  });

  constructor(handlers: ScanBarHandlers, ways: readonly HTMLElement[]) {
    const digits = ["Digit1", "Digit2", "Digit3"];
    const windows = WINDOWS.map((one, i) =>
      this.tool(one.name, one.name, `{${digits[i] ?? ""}}`, () => {
        handlers.setWindow(one);
      }),
    );
    this.slider.value = FIRST_OPACITY;
    this.slider.addEventListener("input", () => {
      handlers.opacityChanged();
    });
    const { addScan } = handlers;
    this.element = make(
      "header.scan-bar",
      {},
      make("div.scan-tools", { role: "group", "aria-label": "Window" }, ...windows),
      make(
        "div.scan-tools",
        { role: "group", "aria-label": "Labels" },
        this.tool("labels", "Labels", "{KeyO}", () => {
          handlers.toggleLabels();
        }),
        this.slider,
      ),
      make(
        "div.scan-tools",
        { role: "group", "aria-label": "Measure" },
        this.tool("distance", "Distance", "{KeyM}", () => {
          handlers.measure("distance");
        }),
        this.tool("angle", "Angle", "{KeyN}", () => {
          handlers.measure("angle");
        }),
        this.tool("region", "HU", "{KeyR}", () => {
          handlers.measure("region");
        }),
      ),
      this.tool("planes", "Along the wrist", "{KeyP}", () => {
        handlers.turnPlanes();
      }),
      make(
        "div.scan-ways",
        {},
        ...ways,
        ...(addScan === undefined ? [] : [button("Add a scan…", "", addScan)]),
        button("Help", "?", () => {
          handlers.help();
        }),
      ),
    );
  }

  /** Of the labels, 0 to 1. */
  get opacity(): number {
    return Number(this.slider.value) / 100;
  }

  /** @param percent  more, or less */
  changeOpacity(percent: number): void {
    this.slider.value = String(Number(this.slider.value) + percent);
  }

  show(state: ScanBarState): void {
    const isOn = (id: string, on: boolean): void => {
      this.buttons.get(id)?.setAttribute("aria-pressed", String(on));
    };
    for (const one of WINDOWS) {
      isOn(one.name, one.centre === state.grey.centre && one.width === state.grey.width);
    }
    isOn("labels", state.labelsShown);
    isOn("distance", state.measure === "distance");
    isOn("angle", state.measure === "angle");
    isOn("region", state.measure === "region");
    isOn("planes", state.alignment === "wrist");
  }

  private tool(id: string, label: string, key: string, act: () => void): HTMLButtonElement {
    const made = button(label, key, act);
    this.buttons.set(id, made);
    return made;
  }
}

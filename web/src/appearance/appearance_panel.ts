// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials, lamps and what is shown of the bones' surfaces, changed while one looks at them.
import { button, make, remember, remembered } from "../dom";
import {
  COLOR_FIELDS,
  defaultLook,
  hexOf,
  lookOf,
  MOST_LAMPS,
  MOST_STRENGTH,
  NUMBER_FIELDS,
  rgbOf,
  TISSUES,
  titleOf,
  withLamp,
  withLampCount,
  withMaterial,
  type Lamp,
  type Look,
  type Tissue,
} from "./look_model";
import "./appearance.css";

const KEY = "carpus.look";
const FIELD_NAMES = {
  diffuse: "Colour",
  emissive: "Glow",
  specular: "Shine",
  ambient: "Light from all around",
  shininess: "Sharpness of shine",
  transparency: "Transparency",
} as const;
const SHOWN_NAMES = {
  texture: "Bitmap of each bone, from the CT",
  facets: "Facets",
  hulls: "Convex hulls",
} as const;

function slider(
  label: string,
  value: number,
  [low, high, step]: readonly [number, number, number],
  onInput: (value: number) => void,
): HTMLElement {
  const input = make("input", {
    type: "range",
    min: String(low),
    max: String(high),
    step: String(step),
    value: String(value),
  });
  input.addEventListener("input", () => {
    onInput(Number(input.value));
  });
  return make("label.look-row", {}, make("span", {}, label), input);
}

function colorInput(label: string, value: string, onInput: (hex: string) => void): HTMLElement {
  const input = make("input", { type: "color", value });
  input.addEventListener("input", () => {
    onInput(input.value);
  });
  return make("label.look-row", {}, make("span", {}, label), input);
}

export class AppearancePanel {
  readonly element: HTMLElement;
  private readonly body = make("div.look-body");
  private tissue: Tissue = "bone";
  private look = lookOf(remembered(KEY));
  /** By the button that opened it, so that it is said there too. */
  onOpen: (isOpen: boolean) => void = () => undefined;

  /** @param show  called with each look, not before the first change or `begin`. */
  constructor(private readonly show: (look: Look) => void) {
    const close = button(
      "Close",
      "",
      () => {
        this.open(false);
      },
      ".quiet",
    );
    this.element = make(
      "section.appearance",
      { "aria-label": "Appearance" },
      make("header", {}, make("h2", {}, "Appearance"), close),
      this.body,
    );
    this.element.hidden = true;
    this.element.addEventListener("keydown", (event) => {
      // The theatre's keys are not meant here.
      event.stopPropagation();
      if (event.key === "Escape") this.open(false);
    });
  }

  /** Shows what was remembered. */
  begin(): void {
    this.show(this.look);
  }

  get isOpen(): boolean {
    return !this.element.hidden;
  }

  open(on: boolean): void {
    this.element.hidden = !on;
    if (on) this.build();
    this.onOpen(on);
  }

  private change(look: Look): void {
    this.look = look;
    remember(KEY, JSON.stringify(look));
    this.show(look);
  }

  private build(): void {
    this.body.replaceChildren(this.shown(), this.material(), this.lamps(), this.reset());
  }

  private shown(): HTMLElement {
    const row = (name: keyof typeof SHOWN_NAMES): HTMLElement => {
      const input = make("input", { type: "checkbox", id: `look-${name}` });
      input.checked = this.look[name];
      input.addEventListener("change", () => {
        this.change({ ...this.look, [name]: input.checked });
      });
      return make("label.look-check", {}, input, SHOWN_NAMES[name]);
    };
    return make(
      "fieldset",
      {},
      make("legend", {}, "Bones"),
      row("texture"),
      row("facets"),
      row("hulls"),
    );
  }

  private material(): HTMLElement {
    const choice = make("select", { "aria-label": "Tissue" });
    for (const tissue of TISSUES) {
      choice.append(make("option", { value: tissue }, titleOf(tissue)));
    }
    choice.value = this.tissue;
    choice.addEventListener("change", () => {
      this.tissue = choice.value as Tissue;
      this.build();
      this.body.querySelector("select")?.focus();
    });
    const now = this.look.materials[this.tissue];
    return make(
      "fieldset",
      {},
      make("legend", {}, "Material"),
      choice,
      ...COLOR_FIELDS.map((field) =>
        colorInput(FIELD_NAMES[field], hexOf(now[field]), (hex) => {
          this.change(withMaterial(this.look, this.tissue, { [field]: rgbOf(hex) }));
        }),
      ),
      ...NUMBER_FIELDS.map((field) =>
        slider(FIELD_NAMES[field], now[field], [0, 1, 0.01], (value) => {
          this.change(withMaterial(this.look, this.tissue, { [field]: value }));
        }),
      ),
    );
  }

  private lamps(): HTMLElement {
    const count = slider("How many", this.look.lamps.length, [1, MOST_LAMPS, 1], (value) => {
      this.change(withLampCount(this.look, value));
      this.build();
      this.body.querySelector<HTMLInputElement>("fieldset.look-lamps input")?.focus();
    });
    return make(
      "fieldset.look-lamps",
      {},
      make("legend", {}, "Lamps, beside the viewer"),
      count,
      ...this.look.lamps.map((lamp, index) => this.lamp(lamp, index)),
    );
  }

  private lamp(lamp: Lamp, index: number): HTMLElement {
    const change = (part: Partial<Lamp>): void => {
      this.change(withLamp(this.look, index, part));
    };
    return make(
      "div.look-lamp",
      { role: "group", "aria-label": `Lamp ${index + 1}` },
      colorInput(`Lamp ${index + 1}`, hexOf(lamp.color), (hex) => {
        change({ color: rgbOf(hex) });
      }),
      slider("Strength", lamp.strength, [0, MOST_STRENGTH, 0.05], (strength) => {
        change({ strength });
      }),
      slider("Left, right", lamp.right, [-180, 180, 1], (right) => {
        change({ right });
      }),
      slider("Below, above", lamp.up, [-90, 90, 1], (up) => {
        change({ up });
      }),
    );
  }

  private reset(): HTMLElement {
    return button("As it was at first", "", () => {
      this.change(defaultLook());
      this.build();
    });
  }
}

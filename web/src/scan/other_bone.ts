// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a part that is cut off, or a whole bone, becomes: another bone, or none. Nothing is chosen until a person
// chooses.
import { make } from "../dom";
import { nameOfLabel } from "./bones_now_model";
import { boneTitle, KNOWN_BONES } from "./scan_case_model";

const NONE = "0";

export class OtherBone {
  readonly element: HTMLElement;
  private readonly select: HTMLSelectElement;
  private readonly options: readonly (readonly [number, HTMLOptionElement])[];

  constructor(changed: () => void) {
    this.options = KNOWN_BONES.map(
      ([label]) => [label, make("option", { value: String(label) })] as const,
    );
    this.select = make(
      "select",
      {},
      make("option", { value: "" }, "Choose…"),
      make("option", { value: NONE }, "No bone"),
      ...this.options.map(([, option]) => option),
    );
    this.select.addEventListener("change", changed);
    this.element = make("label", {}, "It becomes ", this.select);
  }

  /** 0 for no bone; undefined while nothing is chosen. */
  get label(): number | undefined {
    return this.select.value === "" ? undefined : Number(this.select.value);
  }

  clear(): void {
    this.select.value = "";
  }

  focus(): void {
    this.select.focus();
  }

  /** @param inHand  cannot become itself */
  show(inHand: number, count: (label: number) => number): void {
    for (const [label, option] of this.options) {
      const title = boneTitle(nameOfLabel(label, count));
      option.textContent = count(label) > 0 ? title : `${title} (not there)`;
      option.disabled = label === inHand;
    }
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Elements without a framework.
import { keyCap, nameShortcut } from "../key_caps";

type Child = Node | string;
type Attributes = Readonly<Record<string, string>>;

/** `make("button.quiet", {type: "button"}, "Undo")`. Text is text, never markup. */
export function make<K extends keyof HTMLElementTagNameMap>(
  spec: K | `${K}.${string}`,
  attributes: Attributes = {},
  ...children: readonly Child[]
): HTMLElementTagNameMap[K] {
  const [tag, ...classes] = spec.split(".") as [K, ...string[]];
  const element = document.createElement(tag);
  if (classes.length > 0) element.className = classes.join(" ");
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** A button that says what it does and, where there is one, its key (as {KeyA}). */
export function button(
  label: string,
  key: string,
  onClick: () => void,
  more = "",
): HTMLButtonElement {
  const element = make(`button${more}` as "button", { type: "button" }, label);
  if (key !== "") {
    element.append(keyCap(key));
    nameShortcut(element, key);
  }
  element.addEventListener("click", onClick);
  return element;
}

/** Sets text only where it changed, so that readers and layout are left alone. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

const SVG = "http://www.w3.org/2000/svg";

export function makeSvg(
  tag: string,
  attributes: Readonly<Record<string, string | number>> = {},
  ...children: readonly Child[]
): SVGElement {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

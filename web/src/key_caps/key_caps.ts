// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Key caps on the page: each shows what the person's own keyboard has there, also once more is known of it.
import { labelled, labelsOf, learnt, type KeyLabels } from "./key_label_model";

/** Chromium's Keyboard API, where the page is served securely. */
interface NavigatorWithKeyboard {
  readonly keyboard?: { getLayoutMap(): Promise<Iterable<readonly [string, string]>> };
}

let labels: KeyLabels = new Map();

/** The text with the names of its keys as they are shown now. */
export function withKeys(text: string): string {
  return labelled(text, labels);
}

/** @param keys  as {KeyA}, with words about it */
export function keyCap(keys: string): HTMLElement {
  const cap = document.createElement("kbd");
  cap.dataset["keys"] = keys;
  cap.textContent = withKeys(keys);
  return cap;
}

/** Says to assistive technology what key does the same. */
export function nameShortcut(element: HTMLElement, keys: string): void {
  element.dataset["shortcut"] = keys;
  element.setAttribute("aria-keyshortcuts", withKeys(keys));
}

function show(newer: KeyLabels): void {
  if (newer === labels) return;
  labels = newer;
  for (const cap of document.querySelectorAll<HTMLElement>("[data-keys]"))
    cap.textContent = withKeys(cap.dataset["keys"] ?? "");
  for (const element of document.querySelectorAll<HTMLElement>("[data-shortcut]"))
    element.setAttribute("aria-keyshortcuts", withKeys(element.dataset["shortcut"] ?? ""));
}

/** Finds out what is printed on the keys: from the browser where it tells, else from what is typed. */
export function followLayout(signal: AbortSignal): void {
  const { keyboard } = navigator as NavigatorWithKeyboard;
  keyboard?.getLayoutMap().then(
    (layout) => {
      show(labelsOf(layout));
    },
    () => undefined,
  );
  window.addEventListener(
    "keydown",
    (event) => {
      const { code, key, shiftKey, ctrlKey, altKey, metaKey } = event;
      const modified =
        shiftKey || ctrlKey || altKey || metaKey || event.getModifierState("AltGraph");
      show(learnt(labels, { code, key, modified }));
    },
    { signal, capture: true },
  );
}

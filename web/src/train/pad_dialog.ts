// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Goes through the dialog that is open as the keys would, for whoever holds a gamepad.
import type { DialogStep } from "../gamepad";

const REACHED = "button, input, select, summary, [tabindex='0']";

function reachable(dialog: HTMLDialogElement): HTMLElement[] {
  return [...dialog.querySelectorAll<HTMLElement>(REACHED)].filter(
    (one) => !one.matches(":disabled") && one.checkVisibility(),
  );
}

function isRadio(element: Element): element is HTMLInputElement {
  return element instanceof HTMLInputElement && element.type === "radio";
}

/** Changes a list's or a slider's value by one; nothing of another element. */
function changed(element: Element | null, by: 1 | -1): boolean {
  if (element instanceof HTMLSelectElement) {
    const at = element.selectedIndex + by;
    if (at >= 0 && at < element.options.length) element.selectedIndex = at;
  } else if (element instanceof HTMLInputElement && element.type === "range") {
    if (by > 0) element.stepUp();
    else element.stepDown();
  } else {
    return false;
  }
  for (const kind of ["input", "change"]) element.dispatchEvent(new Event(kind, { bubbles: true }));
  return true;
}

export function goThroughDialog(step: DialogStep): void {
  const open = [...document.querySelectorAll<HTMLDialogElement>("dialog[open]")].at(-1);
  if (open === undefined) return;
  const focused = document.activeElement;
  const by = step === "next" || step === "more" ? 1 : -1;
  switch (step) {
    case "choose":
      if (!(focused instanceof HTMLElement) || !open.contains(focused)) return;
      // One of several is chosen by going there, as with the arrows: this says yes to it.
      if (isRadio(focused) && focused.form !== null) focused.form.requestSubmit();
      else focused.click();
      return;
    case "close":
      if (open.dispatchEvent(new Event("cancel", { cancelable: true }))) open.close();
      return;
    case "more":
    case "less":
      if (changed(focused, by)) return;
      break;
    default:
      break;
  }
  const all = reachable(open);
  const at = all.findIndex((one) => one === focused);
  const to = at < 0 ? (by > 0 ? 0 : all.length - 1) : (at + by + all.length) % all.length;
  const there = all[to];
  there?.focus();
  if (there !== undefined && isRadio(there)) there.click();
}

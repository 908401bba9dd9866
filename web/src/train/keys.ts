// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which keys go where: to the hand while it operates, else to an action; never past an open dialog.
import type { Pedal } from "../c_arm";
import { isPedal, onceAction, type KeyPress, type OnceAction } from "../operation";
import type { Hand } from "./hand";

export interface KeyHandlers {
  readonly hand: Hand;
  readonly pedal: Pedal;
  /** Where the keys belong while one operates. */
  readonly canvas: HTMLCanvasElement;
  act(action: OnceAction): void;
  /** The open help's own key closes it. */
  closeHelp(): boolean;
}

/** Listens until `signal` says stop. */
export function listenToKeys(handlers: KeyHandlers, signal: AbortSignal): void {
  window.addEventListener(
    "keydown",
    (event) => {
      keyDown(handlers, event);
    },
    { signal },
  );
  window.addEventListener(
    "keyup",
    (event) => {
      handlers.pedal.release(event.code);
      handlers.hand.letGo(event.code, performance.now());
    },
    { signal },
  );
  // After a click the keys go to the hand again; who came by Tab stays where they are.
  document.addEventListener(
    "click",
    (event) => {
      if (event.detail === 0 || document.querySelector("dialog[open]") !== null) return;
      if (event.target instanceof Element && event.target.closest("button") !== null) {
        handlers.canvas.focus({ preventScroll: true });
      }
    },
    { signal },
  );
}

function keyDown({ hand, pedal, act, closeHelp }: KeyHandlers, event: KeyboardEvent): void {
  if (event.altKey || event.metaKey) return;
  const press: KeyPress = {
    key: event.key,
    code: event.code,
    shift: event.shiftKey,
    ctrl: event.ctrlKey,
  };
  const once = onceAction(press);
  if (once?.kind === "help" && closeHelp()) {
    event.preventDefault();
    return;
  }
  if (document.querySelector("dialog[open]") !== null) return;
  const target = event.target instanceof HTMLElement ? event.target : undefined;
  // A closed dialog's input keeps the focus until the page is drawn next; the key that closed it was its own.
  if (
    target instanceof HTMLInputElement &&
    (event.defaultPrevented || target.closest("dialog:not([open])") === null)
  )
    return;
  if (target instanceof HTMLButtonElement && (event.key === " " || event.key === "Enter")) return;
  if (isPedal(press)) {
    event.preventDefault();
    if (!event.repeat) pedal.press(event.code);
    return;
  }
  if (hand.keyDown(press, performance.now(), event.repeat)) {
    event.preventDefault();
    return;
  }
  if (once === undefined) return;
  event.preventDefault();
  if (!event.repeat || once.kind === "turn_c_arm") act(once);
}

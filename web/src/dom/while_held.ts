// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A button that does something for as long as it is held: by pointer, finger, Space or Enter. It is let go
// whenever it could no longer be told that it was.

/** @param press, release  with what holds it, each once */
export function whileHeld(
  button: HTMLButtonElement,
  press: (holder: string) => void,
  release: (holder: string) => void,
): void {
  const holders = new Set<string>();
  const down = (holder: string): void => {
    if (holders.has(holder)) return;
    holders.add(holder);
    press(holder);
  };
  const up = (holder: string): void => {
    if (holders.delete(holder)) release(holder);
  };
  const upAll = (): void => {
    for (const holder of [...holders]) up(holder);
  };
  button.style.touchAction = "none";
  button.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    button.setPointerCapture(event.pointerId);
    down(`pointer ${event.pointerId}`);
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
    button.addEventListener(end, (event) => {
      up(`pointer ${event.pointerId}`);
    });
  }
  // A finger that rests is no wish for a menu.
  button.addEventListener("contextmenu", (event) => {
    event.preventDefault();
  });
  button.addEventListener("keydown", (event) => {
    if (event.code !== "Space" && event.code !== "Enter") return;
    event.preventDefault();
    if (!event.repeat) down(`key ${event.code}`);
  });
  button.addEventListener("keyup", (event) => {
    up(`key ${event.code}`);
  });
  button.addEventListener("blur", upAll);
  window.addEventListener("blur", upAll);
}

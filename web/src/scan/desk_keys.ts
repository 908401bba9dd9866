// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the keys do on a scan's desk; what its help says of them is scan_keys_model.ts.
import type { MeasureKind } from "./measure_model";

export interface DeskActs {
  /** The keys are somebody else's now. */
  isAway(): boolean;
  /** In the picture that has the focus: by pixels, by mm in its plane, by slices. */
  shiftPicture(right: number, down: number): void;
  moveCross(rightMm: number, downMm: number): void;
  scroll(slices: number): void;
  zoom(factor: number): void;
  fit(): void;
  /** Enter on a picture. @return whether something in hand did it */
  atCross(): boolean;
  /** @return whether the tools that mend took it */
  mend(event: KeyboardEvent): boolean;
  window(which: number): void;
  changeOpacity(percent: number): void;
  toggleLabels(): void;
  toggleCross(): void;
  nextBone(by: number): void;
  measure(kind: MeasureKind): void;
  dropMeasure(): void;
  turnPlanes(): void;
  putDown(): void;
  help(): void;
}

const FINE_MM = 0.3;
const COARSE_MM = 3;
const SHIFT_PIXELS = 30;
const MANY_SLICES = 10;
const ZOOM = 1.12;
const OPACITY_PERCENT = 10;
const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

function moves(event: KeyboardEvent, acts: DeskActs): boolean {
  const arrow = ARROWS[event.key];
  if (arrow !== undefined && event.ctrlKey) {
    acts.shiftPicture(-SHIFT_PIXELS * arrow[0], -SHIFT_PIXELS * arrow[1]);
  } else if (arrow !== undefined) {
    const mm = event.shiftKey ? COARSE_MM : FINE_MM;
    acts.moveCross(mm * arrow[0], mm * arrow[1]);
  } else if (event.key === "PageUp" || event.key === "PageDown") {
    const many = event.shiftKey ? MANY_SLICES : 1;
    acts.scroll(event.key === "PageDown" ? many : -many);
  } else return false;
  return true;
}

function actOfCode(event: KeyboardEvent, acts: DeskActs): (() => void) | undefined {
  const all: Readonly<Record<string, () => void>> = {
    Digit0: acts.fit,
    Digit1: () => {
      acts.window(0);
    },
    Digit2: () => {
      acts.window(1);
    },
    Digit3: () => {
      acts.window(2);
    },
    BracketLeft: () => {
      acts.changeOpacity(-OPACITY_PERCENT);
    },
    BracketRight: () => {
      acts.changeOpacity(OPACITY_PERCENT);
    },
    KeyO: acts.toggleLabels,
    KeyX: acts.toggleCross,
    KeyB: () => {
      acts.nextBone(event.shiftKey ? -1 : 1);
    },
    KeyM: () => {
      acts.measure("distance");
    },
    KeyN: () => {
      acts.measure("angle");
    },
    KeyR: () => {
      acts.measure("region");
    },
    KeyP: acts.turnPlanes,
    Backspace: acts.dropMeasure,
    Escape: acts.putDown,
  };
  return all[event.code];
}

function doesByKey(event: KeyboardEvent, acts: DeskActs, isOnPicture: boolean): boolean {
  if (event.ctrlKey || event.altKey) return false;
  if (event.key === "+" || event.key === "=") acts.zoom(ZOOM);
  else if (event.key === "-") acts.zoom(1 / ZOOM);
  else if (event.key === "?") acts.help();
  else if (event.key === "Enter" && isOnPicture && acts.atCross()) return true;
  else if (acts.mend(event)) return true;
  else {
    const act = actOfCode(event, acts);
    act?.();
    return act !== undefined;
  }
  return true;
}

/** For the desk's keydown. */
export function takeKey(event: KeyboardEvent, acts: DeskActs): void {
  const { target } = event;
  const isField = target instanceof HTMLSelectElement || target instanceof HTMLInputElement;
  if (isField || acts.isAway() || event.metaKey) return;
  const isOnPicture = target instanceof HTMLCanvasElement;
  if ((isOnPicture && moves(event, acts)) || doesByKey(event, acts, isOnPicture)) {
    event.preventDefault();
  }
}

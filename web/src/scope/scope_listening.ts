// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys, mouse and fingers of an arthroscopy, as what they ask for.
import { fluidAct } from "./fluid_controls";
import type { FluidAct } from "./fluid_model";
import type { Lead } from "./scope_hands";
import { focusBy, scopeAct, scopeMotion, type ScopeAct, type ScopeMotion } from "./scope_keys";
import { ScopePointers, type PointerAsk } from "./scope_pointers";
import { hasJaws, type ToolKind } from "./scope_tools";

const LEAN_RAD_PER_PX = (0.12 * Math.PI) / 180;
const WHEEL_MM = 0.6;
/** Two fingers that go apart by the width of one go in by two or three millimetres. */
const SPREAD_MM_PER_PX = 0.06;
const TURN_DEG_PER_PX = 0.6;

export interface ScopeAsked {
  takesKeys(): boolean;
  /** Its picture stands beside the skin that a hand works on: one key changes which is large. */
  isBeside(): boolean;
  /** Which of them there are hangs on what works beside the scope, and on whether there is fluid. */
  readonly tool: ToolKind;
  readonly hasFluid: boolean;
  press(holder: string, motion: ScopeMotion): void;
  letGo(holder: string): void;
  letGoOfAll(): void;
  act(act: ScopeAct): void;
  actOnFluid(act: FluidAct): void;
  lean(lead: Lead, yawRad: number, pitchRad: number): void;
  turn(deg: number): void;
  advance(mm: number): void;
}

/** @param picture  takes mouse and fingers on its canvas */
export function listenForScope(picture: HTMLElement, asked: ScopeAsked, signal: AbortSignal): void {
  listenToKeys(asked, signal);
  listenToPointers(picture, asked, signal);
  listenToMouse(picture, asked, signal);
}

/** One key: jaws go by one press, a pedal is held down. */
function actOf(code: string, tool: ToolKind): ScopeAct | undefined {
  const act = scopeAct(code);
  return act === "jaws" && !hasJaws(tool) ? undefined : act;
}

function motionOf(code: string, shift: boolean, tool: ToolKind): ScopeMotion | undefined {
  const isPedal = scopeAct(code) === "jaws" && tool === "shaver";
  return isPedal ? { kind: "run" } : scopeMotion(code, shift);
}

function isForPage(event: KeyboardEvent): boolean {
  if (event.altKey || event.metaKey || event.ctrlKey) return true;
  if (document.querySelector("dialog[open]") !== null) return true;
  return event.target instanceof HTMLInputElement;
}

function listenToKeys(asked: ScopeAsked, signal: AbortSignal): void {
  window.addEventListener(
    "keydown",
    (event) => {
      if (isForPage(event)) return;
      if (!asked.takesKeys()) {
        if (scopeAct(event.code) !== "panorama" || !asked.isBeside()) return;
        event.preventDefault();
        event.stopImmediatePropagation();
        if (!event.repeat) asked.act("panorama");
        return;
      }
      const motion = motionOf(event.code, event.shiftKey, asked.tool);
      const act = actOf(event.code, asked.tool);
      const tap = asked.hasFluid ? fluidAct(event.code) : undefined;
      if (motion === undefined && act === undefined && tap === undefined) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      if (motion !== undefined) asked.press(event.code, motion);
      else if (act !== undefined) {
        // A ring is turned on while its key is held.
        if (!event.repeat || focusBy(act) !== 0) asked.act(act);
      } else if (tap !== undefined && !event.repeat) asked.actOnFluid(tap);
    },
    { signal, capture: true },
  );
  window.addEventListener(
    "keyup",
    (event) => {
      asked.letGo(event.code);
    },
    { signal, capture: true },
  );
  window.addEventListener(
    "blur",
    () => {
      asked.letGoOfAll();
    },
    { signal },
  );
}

function ask(asked: ScopeAsked, what: PointerAsk): void {
  switch (what.kind) {
    case "lean":
      asked.lean(what.lead, what.right * LEAN_RAD_PER_PX, what.up * LEAN_RAD_PER_PX);
      return;
    case "turn":
      asked.turn(-what.right * TURN_DEG_PER_PX);
      return;
    case "spread":
      asked.advance(what.apart * SPREAD_MM_PER_PX);
  }
}

function listenToPointers(picture: HTMLElement, asked: ScopeAsked, signal: AbortSignal): void {
  const pointers = new ScopePointers();
  picture.addEventListener(
    "pointerdown",
    (event) => {
      const { target, pointerId: id, clientX: x, clientY: y } = event;
      if (!(target instanceof HTMLCanvasElement)) return;
      const box = target.getBoundingClientRect();
      const turns = event.button === 2 || event.shiftKey;
      const isFinger = event.pointerType === "touch";
      const isTaken = pointers.down({ id, isFinger, turns, x, y }, box.left + box.width / 2);
      if (isTaken) target.setPointerCapture(id);
    },
    { signal },
  );
  picture.addEventListener(
    "pointermove",
    (event) => {
      const what = pointers.move(event.pointerId, event.clientX, event.clientY, event.shiftKey);
      if (what !== undefined && event.buttons !== 0) ask(asked, what);
    },
    { signal },
  );
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
    picture.addEventListener(
      end,
      (event) => {
        pointers.up(event.pointerId);
      },
      { signal },
    );
  }
}

function listenToMouse(picture: HTMLElement, asked: ScopeAsked, signal: AbortSignal): void {
  picture.addEventListener(
    "contextmenu",
    (event) => {
      event.preventDefault();
    },
    { signal },
  );
  picture.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      // With Shift many browsers turn it across.
      const away = -Math.sign(event.deltaY === 0 ? event.deltaX : event.deltaY);
      if (!event.shiftKey) asked.advance(away * WHEEL_MM);
      else if (away !== 0) asked.act(away > 0 ? "focus_farther" : "focus_nearer");
    },
    { signal, passive: false },
  );
}

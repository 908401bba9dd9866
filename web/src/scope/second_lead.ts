// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a gamepad asks for at a scope, where it leads the hand that mouse and keys do not: two hands at
// once. Sticks lean and turn, bumpers draw back and go in, the triggers close and open jaws or run a
// shaver, its cross pulls and focuses. Pure.
import type { HeldAction, OnceAction } from "../operation";
import { focusBy, type ScopeMotion } from "./scope_keys";
import type { ToolKind } from "./scope_tools";

/** Of the hand that mouse and keys do not lead. */
export interface SecondLead {
  readonly tool: ToolKind;
  lean(yawRad: number, pitchRad: number): void;
  /** What that hand holds: the scope with its camera head, or a shaver's mouth. */
  turn(shaftDeg: number, cameraDeg: number): void;
  hold(holder: string, motion: ScopeMotion): void;
  letGo(holder: string): void;
  setJaws(closed: boolean): void;
  goToNextPortal(): void;
  /** Exchanges the hands. */
  switchHands(): void;
  /** @param byN  more traction, or less */
  pull(byN: number): void;
}

/** The stick that moves a tip by 30 mm/s leans by the arrows' 28 degrees/s. */
const LEAN_RAD_PER_MM = ((28 / 30) * Math.PI) / 180;
const PULL_N = 5;
/** Of the pad's buttons these mean at a scope what they mean elsewhere. */
const AS_ELSEWHERE: ReadonlySet<OnceAction["kind"]> = new Set([
  "free_shot",
  "pause",
  "camera",
  "undo",
  "finish",
]);

export class PadAtScope {
  /** @param turnFocus  of the camera head's ring, by so many steps, whoever leads the scope */
  constructor(
    private readonly second: SecondLead,
    private readonly turnFocus: (steps: number) => void,
  ) {}

  /** @param right  as a tip would be moved on the screen [mm] */
  moveTipBy(right: number, up: number): void {
    this.second.lean(right * LEAN_RAD_PER_MM, up * LEAN_RAD_PER_MM);
  }

  /** @param right  as a shaft's tail would be turned on the screen [rad] */
  turnShaftBy(right: number, up: number): void {
    const deg = 180 / Math.PI;
    this.second.turn(right === 0 ? 0 : -right * deg, up * deg);
  }

  hold(holder: string, action: HeldAction): void {
    switch (action.kind) {
      case "approach":
        this.second.hold(holder, { kind: "advance", by: action.closer ? 1 : -1 });
        return;
      case "drive":
        if (this.second.tool === "grasper") this.second.setJaws(action.driver === "forward");
        else if (this.second.tool === "shaver" && action.driver === "forward") {
          this.second.hold(holder, { kind: "run" });
        }
        return;
      case "orbit":
        if (action.to === "up") this.second.pull(PULL_N);
        if (action.to === "down") this.second.pull(-PULL_N);
        if (action.to === "left") this.turnFocus(focusBy("focus_nearer"));
        if (action.to === "right") this.turnFocus(focusBy("focus_farther"));
        return;
      default:
    }
  }

  letGo(holder: string): void {
    this.second.letGo(holder);
  }

  /** @returns  whether the room does it, as it does elsewhere */
  act(action: OnceAction): boolean {
    if (action.kind === "switch_hand") this.second.switchHands();
    if (action.kind === "aim_along_sight") this.second.goToNextPortal();
    return AS_ELSEWHERE.has(action.kind);
  }
}

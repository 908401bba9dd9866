// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the hands hold and feel, and the ways on, back and out. A way that is not open now says why.
import { button, make, setText } from "../dom";
import { keyCap } from "../key_caps";
import { heldItem, type HandIndex } from "../operation";
import type { Driver, ExerciseMessage, Item, SnapshotMessage } from "../protocol";
import type { OfferedControls } from "./offered_controls_model";
import { Sparkline } from "./sparkline";
import "./bottom_bar.css";

export interface BottomBarHandlers {
  hand(hand: HandIndex): void;
  tray(): void;
  measure(): void;
  pickUp(): void;
  pickUpFarEnd(): void;
  putDown(): void;
  undo(): void;
  restart(): void;
  finish(): void;
  decline(): void;
}

/** Why each way cannot be gone now, in the host's words; nothing where it can. */
export interface ClosedWays {
  readonly measure: string | undefined;
  readonly putDown: string | undefined;
  readonly undo: string | undefined;
  readonly finish: string | undefined;
  readonly decline: string | undefined;
  /** Whether anything lies in bone that the hand could take hold of. */
  readonly canPickUp: boolean;
  readonly canPickUpFarEnd: boolean;
}

/** Length of the force on a hand [N]. */
export function forceN(s: SnapshotMessage, hand: HandIndex): number {
  return Math.hypot(...s.hands[hand].force_n);
}

const DRIVING: Readonly<Record<Driver, string>> = {
  off: "",
  forward: "driving, ",
  reverse: "reversing, ",
};
const HANDS = ["First hand", "Second hand"] as const;

export class BottomBar {
  readonly element: HTMLElement;
  private readonly hands: readonly [HTMLButtonElement, HTMLButtonElement];
  private readonly driver = make("span");
  private readonly depth = make("span.depth");
  private readonly resistance = make("span");
  private readonly force = make("span");
  private readonly torque = make("span");
  private readonly gauge = make("span");
  private readonly holding = make("span");
  private readonly sparkline = new Sparkline();
  private readonly ways: Readonly<
    Record<
      "measure" | "putDown" | "pickUp" | "pickUpFarEnd" | "undo" | "finish" | "decline",
      HTMLButtonElement
    >
  >;
  private exercise: ExerciseMessage | undefined;

  constructor(handlers: BottomBarHandlers) {
    const hand = (index: HandIndex): HTMLButtonElement => {
      const b = make("button.quiet.hand", { type: "button" }, `${index + 1} empty`);
      b.addEventListener("click", () => {
        handlers.hand(index);
      });
      return b;
    };
    this.hands = [hand(0), hand(1)];
    this.ways = {
      measure: button("Measure", "{KeyM}", handlers.measure, ".quiet"),
      putDown: button("Put down", "{KeyQ}", handlers.putDown, ".quiet"),
      pickUp: button("Take hold", "{KeyG}", handlers.pickUp, ".quiet"),
      pickUpFarEnd: button("Other end", "Shift + {KeyG}", handlers.pickUpFarEnd, ".quiet"),
      undo: button("Undo", "{KeyZ}", handlers.undo, ".quiet"),
      finish: button("Finish", "{KeyF}", handlers.finish),
      decline: button("Decline…", "Del", handlers.decline, ".quiet"),
    };
    this.element = make(
      "footer.bottom-bar",
      { "aria-label": "Instruments" },
      make(
        "div.readings",
        {},
        make(
          "div.hands",
          { role: "group", "aria-label": "Hands" },
          ...this.hands,
          keyCap("{KeyH}"),
        ),
        this.driver,
        this.depth,
        this.resistance,
        this.force,
        this.torque,
        this.sparkline.canvas,
        this.gauge,
        this.holding,
      ),
      make(
        "div.ways",
        {},
        button("Tray", "{KeyC}", handlers.tray, ".quiet"),
        this.ways.measure,
        this.ways.pickUp,
        this.ways.pickUpFarEnd,
        this.ways.putDown,
        this.ways.undo,
        button("Restart", "", handlers.restart, ".quiet"),
        this.ways.decline,
        this.ways.finish,
      ),
    );
  }

  setExercise(exercise: ExerciseMessage): void {
    this.exercise = exercise;
  }

  /** Ways that this procedure has no use for are not there. */
  offer(offered: OfferedControls): void {
    this.ways.measure.hidden = !offered.gauge;
    this.ways.decline.hidden = !offered.decline;
    this.driver.hidden = !offered.drive;
  }

  sample(s: SnapshotMessage, hand: HandIndex): void {
    this.sparkline.push(forceN(s, hand));
  }

  show(s: SnapshotMessage, active: HandIndex, driver: Driver, thrustN: number): void {
    for (const hand of [0, 1] as const) this.showHand(s, hand, hand === active);
    const item = heldItem(s, active);
    setText(
      this.driver,
      item === undefined ? "" : `${DRIVING[driver]}push ${thrustN.toFixed(0)} N`,
    );
    this.driver.classList.toggle("running", driver !== "off");
    setText(this.depth, item === undefined ? "" : this.depthText(item, s, active));
    const { resistance_n, torque_n_mm } = s.hands[active];
    setText(this.torque, torque_n_mm > 0 ? `torque ${torque_n_mm.toFixed(0)} N mm` : "");
    setText(this.resistance, resistance_n > 0 ? `bone resists ${resistance_n.toFixed(0)} N` : "");
    setText(this.force, item === undefined ? "" : `force ${forceN(s, active).toFixed(1)} N`);
    const { gauge_reading_mm } = s;
    setText(this.gauge, gauge_reading_mm === null ? "" : `gauge ${gauge_reading_mm.toFixed(1)} mm`);
    setText(
      this.holding,
      this.isScrewSeated(s) ? `holds ${Math.round(100 * s.holding_share)} % of untouched bone` : "",
    );
    this.sparkline.draw();
  }

  showWays(ways: ClosedWays): void {
    show(this.ways.measure, ways.measure);
    show(this.ways.putDown, ways.putDown);
    show(this.ways.undo, ways.undo);
    show(this.ways.finish, ways.finish);
    show(this.ways.decline, ways.decline);
    this.ways.pickUp.hidden = !ways.canPickUp;
    this.ways.pickUpFarEnd.hidden = !ways.canPickUpFarEnd;
  }

  private showHand(s: SnapshotMessage, hand: HandIndex, isActive: boolean): void {
    const b = this.hands[hand];
    const item = heldItem(s, hand);
    const name = this.exercise?.instruments.find((one) => one.id === item?.instrument)?.name;
    setText(b, `${hand + 1} ${name ?? "empty"}`);
    b.setAttribute("aria-pressed", String(isActive));
    b.title = `${HANDS[hand]}: ${name ?? "empty"}${isActive ? ", moved by mouse and keys" : ""}`;
  }

  private depthText(item: Item, s: SnapshotMessage, hand: HandIndex): string {
    if (item.body === "") {
      const { touched_body, touching } = s.hands[hand];
      return touching ? `touches the ${this.label(touched_body)}` : "free";
    }
    // How deep a tail lies is for the pictures to tell in an assessed operation.
    if (!this.isScrew(item) || this.exercise?.mode === "assessed")
      return `depth ${item.depth_mm.toFixed(1)} mm`;
    const mm = Math.abs(item.buried_mm).toFixed(1);
    return item.buried_mm < 0 ? `tail stands out ${mm} mm` : `tail buried ${mm} mm`;
  }

  private isScrew(item: Item): boolean {
    const kind = this.exercise?.instruments.find((one) => one.id === item.instrument);
    return kind !== undefined && kind.family !== "";
  }

  /** Some screw lies in the bone that is operated on, its tail below the surface. */
  private isScrewSeated(s: SnapshotMessage): boolean {
    return s.items.some((item) => this.isScrew(item) && item.in_target && item.buried_mm >= 0);
  }

  private label(body: string): string {
    return this.exercise?.bodies.find((one) => one.name === body)?.label ?? body;
  }
}

/** Not `disabled`: who presses it hears the reason. */
function show(way: HTMLButtonElement, why: string | undefined): void {
  way.setAttribute("aria-disabled", String(why !== undefined));
  way.title = why ?? "";
}

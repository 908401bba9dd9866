// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where two hands are wanted: each before or in a portal, leant about its hole, or on its way round the wrist
// to the next one. Mouse and keys lead one of them, a gamepad or a second finger the other.
import type { BodyPose, ExerciseMessage, Item, SnapshotMessage, Vec3 } from "../protocol";
import { add, length, rotated, subtract } from "../tool_placement";
import {
  advanced,
  heldBack,
  isBefore,
  leanAt,
  leaned,
  mostBeyondMm,
  NOT_PRESSED,
  notAhead,
  OUTSIDE,
  pressed,
  wayRound,
  wishOf,
  type Lean,
  type PortalNow,
  type Press,
  type Wish,
} from "./scope_hand_model";
import type { Plan, PlanPortal } from "./scope_plan";

export type HandIndex = 0 | 1;
/** Who leads a hand: mouse, keys and the first finger, or a gamepad and the second finger. */
export type Lead = "first" | "second";

const IN_JOINT_MM_PER_S = 6;
const OUTSIDE_MM_PER_S = 25;
/** So near to a place of its way round the wrist it goes on to the next [mm]. */
const ROUNDED_MM = 5;
/** Farther out nothing holds a hand back [mm]. */
const HELD_BACK_MM = 5;

interface Held {
  readonly portal: number;
  readonly lean: Lean;
}

interface Tip {
  readonly tipMm: Vec3;
  readonly mostBeyondMm: number;
}

export class ScopeHands {
  /** The hand that mouse and keys lead. */
  moved: HandIndex = 0;
  /** The host's, in the exercise's order of bodies. */
  poses: readonly BodyPose[] = [];
  private exercise: ExerciseMessage | undefined;
  private plan: Plan | undefined;
  private readonly held: [Held, Held] = [
    { portal: 0, lean: OUTSIDE },
    { portal: 1, lean: OUTSIDE },
  ];
  private readonly presses: [Press, Press] = [NOT_PRESSED, NOT_PRESSED];
  /** Of what is in its portal: where it really is, and how far it may press. */
  private readonly tips: [Tip | undefined, Tip | undefined] = [undefined, undefined];
  /** What is left of a hand's way round the wrist to its next portal. */
  private readonly rounds: [readonly Wish[], readonly Wish[]] = [[], []];

  begin(exercise: ExerciseMessage): void {
    this.exercise = exercise;
    this.plan = exercise.arthroscopy ?? undefined;
    this.held[0] = { portal: 0, lean: OUTSIDE };
    this.held[1] = { portal: 1, lean: OUTSIDE };
    this.rounds[0] = this.rounds[1] = [];
    this.presses[0] = this.presses[1] = NOT_PRESSED;
    this.tips[0] = this.tips[1] = undefined;
    this.moved = 0;
  }

  ledBy(lead: Lead): HandIndex {
    return (lead === "first") === (this.moved === 0) ? 0 : 1;
  }

  /** Those that there are now: they may be made in the exercise. */
  setPortals(portals: readonly PlanPortal[]): void {
    if (this.plan !== undefined) this.plan = { ...this.plan, portals };
  }

  /** Of the plan's portals the one that a hand is before or in. */
  portalOf(hand: HandIndex): Plan["portals"][number] | undefined {
    return this.plan?.portals[this.held[hand].portal];
  }

  /** The same, where it is now. */
  portalNowOf(hand: HandIndex): PortalNow | undefined {
    return this.portalNow(this.held[hand].portal);
  }

  private portalNow(index: number): PortalNow | undefined {
    const { plan, exercise } = this;
    const portal = plan?.portals[index];
    if (plan === undefined || portal === undefined) return undefined;
    const body = exercise?.bodies.findIndex((one) => one.name === portal.body) ?? -1;
    const pose = this.poses[body];
    return {
      skinMm: moved(portal.skin_mm, pose, true),
      inwards: moved(portal.inwards, pose, false),
      up: moved(plan.distal, pose, false),
      capsuleMm: portal.capsule_mm,
    };
  }

  /** Each begins where the host has what it holds; one that is in no portal, before its own.
   * @param inPortal  by hand, as the host says */
  place(items: readonly Item[], inPortal: readonly boolean[]): void {
    for (const { hand, tip_mm: tipMm } of items) {
      if (hand !== 0 && hand !== 1) continue;
      const portal = this.portalNowOf(hand);
      if (portal === undefined) continue;
      const begins = inPortal[hand] === true || isBefore(tipMm, portal);
      this.held[hand] = {
        ...this.held[hand],
        lean: begins ? leanAt(tipMm, portal) : OUTSIDE,
      };
    }
  }

  /** What a hand holds came no farther: the wish goes back to it.
   * @param inPortal  by hand, as the host says
   * @returns  by hand whether the host is to be told anew */
  holdBack(
    { items, hands }: Pick<SnapshotMessage, "items" | "hands">,
    inPortal: readonly boolean[],
    nowMs: number,
  ): readonly [boolean, boolean] {
    const isNew = (hand: HandIndex): boolean => {
      const item = items.find((one) => one.hand === hand);
      const held = this.held[hand];
      const portal = this.portalNowOf(hand);
      this.tips[hand] = undefined;
      if (item === undefined || portal === undefined) return false;
      const isIn = inPortal[hand] === true;
      // Also what is drawn out and comes no farther.
      if (!isIn && held.lean.depthMm < HELD_BACK_MM) return false;
      const { tip_mm: tipMm } = item;
      const forceN = length(hands[hand]?.force_n ?? [0, 0, 0]);
      const press = (this.presses[hand] = pressed(this.presses[hand], forceN, nowMs));
      const mostMm = mostBeyondMm(press, nowMs);
      const lean = heldBack(held.lean, tipMm, portal, { forceN, mostMm });
      this.held[hand] = { ...held, lean };
      if (isIn) this.tips[hand] = { tipMm, mostBeyondMm: mostMm };
      return lean !== held.lean || this.toldOf(hand, portal) !== lean;
    };
    return [isNew(0), isNew(1)];
  }

  /** @returns  whether the hand is to go on to another place of its way round */
  goRound(hand: HandIndex, items: readonly Item[]): boolean {
    const [next, ...rest] = this.rounds[hand];
    if (next === undefined) return false;
    const item = items.find((one) => one.hand === hand);
    // An empty hand passes through nothing.
    const isThere = item === undefined || length(subtract(item.tip_mm, next.tipMm)) < ROUNDED_MM;
    if (!isThere) return false;
    this.rounds[hand] = item === undefined ? [] : rest;
    return true;
  }

  wishOf(hand: HandIndex): Wish | undefined {
    const portal = this.portalNowOf(hand);
    if (portal === undefined) return undefined;
    return this.rounds[hand][0] ?? wishOf(this.toldOf(hand, portal), portal);
  }

  private toldOf(hand: HandIndex, portal: PortalNow): Lean {
    const { lean } = this.held[hand];
    const tip = this.tips[hand];
    return tip === undefined ? lean : notAhead(lean, tip.tipMm, portal, tip.mostBeyondMm);
  }

  lean(hand: HandIndex, yawRad: number, pitchRad: number, nowMs: number): void {
    this.rounds[hand] = []; // a hand that is led goes by itself no longer
    this.ledAt(hand, nowMs);
    const held = this.held[hand];
    this.held[hand] = { ...held, lean: leaned(held.lean, yawRad, pitchRad) };
  }

  private ledAt(hand: HandIndex, nowMs: number): void {
    this.presses[hand] = { ...this.presses[hand], ledMs: nowMs };
  }

  /** @returns  whether there is a portal to go in by */
  advance(hand: HandIndex, mm: number, nowMs: number): boolean {
    this.rounds[hand] = [];
    this.ledAt(hand, nowMs);
    const held = this.held[hand];
    const portal = this.portalNowOf(hand);
    if (portal === undefined) return false;
    this.held[hand] = { ...held, lean: advanced(held.lean, mm, portal) };
    return true;
  }

  /** For so long at a hand's speed: slower in the joint. */
  advanceFor(hand: HandIndex, seconds: number, nowMs: number): boolean {
    const portal = this.portalNowOf(hand);
    if (portal === undefined) return false;
    const isIn = this.held[hand].lean.depthMm > portal.capsuleMm - 3;
    return this.advance(hand, seconds * (isIn ? IN_JOINT_MM_PER_S : OUTSIDE_MM_PER_S), nowMs);
  }

  /** The hand goes to before the next portal that the other one leaves free. */
  goToNextPortal(hand: HandIndex): void {
    const count = this.plan?.portals.length ?? 0;
    if (count === 0) return;
    const { portal } = this.held[hand];
    const taken = this.held[hand === 0 ? 1 : 0].portal;
    let next = (portal + 1) % count;
    if (next === taken) next = (next + 1) % count;
    const from = this.portalNow(portal);
    const to = this.portalNow(next);
    // On its way round to the last portal it goes on from there.
    if (from !== undefined && to !== undefined) {
      this.rounds[hand] = [...this.rounds[hand], ...wayRound(from, to)];
    }
    this.held[hand] = { portal: next, lean: OUTSIDE };
  }
}

/** Where a place or a direction as scanned is now. */
function moved(v: Vec3, pose: BodyPose | undefined, isPoint: boolean): Vec3 {
  if (pose === undefined) return v;
  const [w, x, y, z] = pose.quaternion;
  const sine = Math.hypot(x, y, z);
  const turned =
    sine < 1e-9 ? v : rotated(v, [x / sine, y / sine, z / sine], 2 * Math.atan2(sine, w));
  return isPoint ? add(turned, pose.translation_mm) : turned;
}

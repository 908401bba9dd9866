// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What goes into a joint pivots in the hole of its portal: where a hand wants its tip, from how deep it
// is and how it leans. Pure.
import type { Vec3 } from "../protocol";
import { add, cross, dot, length, normalized, rotated, scaled, subtract } from "../tool_placement";
import { WARN_N } from "./force_limits";

/** A portal as it lies now, Patient [mm]. */
export interface PortalNow {
  readonly skinMm: Vec3;
  readonly inwards: Vec3;
  /** What leaning up goes towards: distal. */
  readonly up: Vec3;
  readonly capsuleMm: number;
}

/** How an instrument is held in its portal. */
export interface Lean {
  readonly depthMm: number;
  /** Of the hand, to the sides and up, from the way in. */
  readonly yawRad: number;
  readonly pitchRad: number;
}

export const OUTSIDE: Lean = { depthMm: -30, yawRad: 0, pitchRad: 0 };

const MOST_LEAN_RAD = (50 * Math.PI) / 180;
/** Within so much of its axis it is before a portal [mm]. */
const BEFORE_MM = 5;
/** Over the last of the way back to the capsule it comes within so much of the way in. */
const UPRIGHT_MM = 8;
const UPRIGHT_RAD = (5 * Math.PI) / 180;
const FARTHEST_OUT_MM = -60;
const FARTHEST_IN_MM = 30;
/** A hand gives way: a wish goes no farther beyond where something holds its tip, at 2 N a mm. One that is let go
 * presses by 2.5 N, enough to be felt and to probe [mm]. */
const LET_GO_MM = 1.25;
/** One that is led on stays at 4 N, of which the page warns: who leads it here does not feel it ... */
const WARNED_MM = 2;
/** ... and for so long has heard and seen that [ms]; whoever goes on then levers hard enough to do harm, and no
 * harder. [E] */
const HEEDS_MS = 700;
const HARMS_MM = 5;
/** A hand was led no longer ago than this: it goes on [ms]. */
const GOES_ON_MS = 250;
/** In a portal a wish runs no farther ahead of a free tip, so that what it comes upon before the page hears of it is
 * pressed by less than 8 N [mm]. */
const MOST_AHEAD_MM = 3.5;
/** Something holds the tip [N]. */
const HELD_N = 0.5;

const clamp = (v: number, low: number, high: number): number => Math.min(high, Math.max(low, v));

/** Leaned by so much more, within what a portal allows; outside it lies along the way in. */
export function leaned(lean: Lean, byYaw: number, byPitch: number): Lean {
  if (lean.depthMm <= 3) return { ...lean, yawRad: 0, pitchRad: 0 };
  return {
    ...lean,
    yawRad: clamp(lean.yawRad + byYaw, -MOST_LEAN_RAD, MOST_LEAN_RAD),
    pitchRad: clamp(lean.pitchRad + byPitch, -MOST_LEAN_RAD, MOST_LEAN_RAD),
  };
}

/** The hole in the capsule lies in the way: what is drawn back to it comes upright. */
function mostLean(depthMm: number, portal: PortalNow): number {
  const share = clamp((depthMm - portal.capsuleMm) / UPRIGHT_MM, 0, 1);
  return UPRIGHT_RAD + (MOST_LEAN_RAD - UPRIGHT_RAD) * share;
}

export function advanced(lean: Lean, byMm: number, portal: PortalNow): Lean {
  const depthMm = clamp(lean.depthMm + byMm, FARTHEST_OUT_MM, portal.capsuleMm + FARTHEST_IN_MM);
  const most = byMm < 0 ? mostLean(depthMm, portal) : MOST_LEAN_RAD;
  const yawRad = clamp(lean.yawRad, -most, most);
  const pitchRad = clamp(lean.pitchRad, -most, most);
  return leaned({ depthMm, yawRad, pitchRad }, 0, 0);
}

export interface Wish {
  readonly tipMm: Vec3;
  readonly shaft: Vec3;
}

export function wishOf(lean: Lean, portal: PortalNow): Wish {
  const side = normalized(cross(portal.inwards, portal.up));
  const up = cross(side, portal.inwards);
  const way = normalized(
    add(
      portal.inwards,
      add(scaled(side, Math.tan(lean.yawRad)), scaled(up, Math.tan(lean.pitchRad))),
    ),
  );
  return { tipMm: add(portal.skinMm, scaled(way, lean.depthMm)), shaft: scaled(way, -1) };
}

/** The lean that holds a tip there; the inverse of wishOf. */
export function leanAt(tipMm: Vec3, portal: PortalNow): Lean {
  const side = normalized(cross(portal.inwards, portal.up));
  const up = cross(side, portal.inwards);
  const to = subtract(tipMm, portal.skinMm);
  const along = dot(to, portal.inwards);
  if (along <= 3) return { depthMm: along, yawRad: 0, pitchRad: 0 };
  return {
    depthMm: length(to),
    yawRad: Math.atan2(dot(to, side), along),
    pitchRad: Math.atan2(dot(to, up), along),
  };
}

/** Whether a tip lies before the portal, on its way in. */
export function isBefore(tipMm: Vec3, portal: PortalNow): boolean {
  const to = subtract(tipMm, portal.skinMm);
  const along = dot(to, portal.inwards);
  return along <= 0 && length(subtract(to, scaled(portal.inwards, along))) <= BEFORE_MM;
}

/** How a hand is led against what it presses on. */
export interface Press {
  /** Since when it is over the warning; undefined where it is not [ms]. */
  readonly warnedSinceMs: number | undefined;
  /** When it was last leaned, or advanced [ms]. */
  readonly ledMs: number;
}
export const NOT_PRESSED: Press = { warnedSinceMs: undefined, ledMs: -Infinity };

/** @param forceN  on the hand */
export function pressed(press: Press, forceN: number, nowMs: number): Press {
  const warnedSinceMs = forceN > WARN_N ? (press.warnedSinceMs ?? nowMs) : undefined;
  return { ...press, warnedSinceMs };
}

/** By how much a hand may go on beyond what holds its tip [mm]. */
export function mostBeyondMm({ warnedSinceMs, ledMs }: Press, nowMs: number): number {
  if (nowMs - ledMs >= GOES_ON_MS) return LET_GO_MM;
  return warnedSinceMs !== undefined && nowMs - warnedSinceMs >= HEEDS_MS ? HARMS_MM : WARNED_MM;
}

/** The same lean, where its tip is wished no farther from where it really is. */
function within(lean: Lean, tipMm: Vec3, portal: PortalNow, mostMm: number): Lean {
  const ahead = subtract(wishOf(lean, portal).tipMm, tipMm);
  const far = length(ahead);
  return far <= mostMm ? lean : leanAt(add(tipMm, scaled(ahead, mostMm / far)), portal);
}

/** Of a hand that presses against what does not yield. @param forceN  on the hand */
export function heldBack(
  lean: Lean,
  tipMm: Vec3,
  portal: PortalNow,
  { forceN, mostMm }: { readonly forceN: number; readonly mostMm: number },
): Lean {
  return forceN < HELD_N ? lean : within(lean, tipMm, portal, mostMm);
}

/** Of a hand in a portal, as it is told to the host. @param mostBeyond  as it may press [mm] */
export function notAhead(lean: Lean, tipMm: Vec3, portal: PortalNow, mostBeyond: number): Lean {
  return within(lean, tipMm, portal, Math.max(MOST_AHEAD_MM, mostBeyond));
}

/** A hand goes round the wrist so far from its middle: beyond hand and thumb [mm]. */
const ROUND_MM = 80;
const ROUND_STEP_RAD = Math.PI / 6;
/** Portals whose ways in lie nearer than this to each other are gone between straight. */
const STRAIGHT_COSINE = Math.cos(Math.PI / 3);

/** Wishes on the way from before one portal to before another that lies round the wrist, so that what is
 * held passes through no bone; none where the way is straight. */
export function wayRound(from: PortalNow, to: PortalNow): readonly Wish[] {
  const across = (v: Vec3): Vec3 => normalized(subtract(v, scaled(from.up, dot(v, from.up))));
  const out = across(scaled(from.inwards, -1));
  const outThere = across(scaled(to.inwards, -1));
  if (dot(out, outThere) > STRAIGHT_COSINE) return [];
  const angle = Math.atan2(dot(cross(out, outThere), from.up), dot(out, outThere));
  const middle = scaled(add(from.skinMm, to.skinMm), 0.5);
  const steps = Math.ceil(Math.abs(angle) / ROUND_STEP_RAD);
  return Array.from({ length: steps + 1 }, (_, i) => {
    const shaft = rotated(out, from.up, (angle * i) / steps);
    return { tipMm: add(middle, scaled(shaft, ROUND_MM)), shaft };
  });
}

/** To -180 to 180. */
export function wrappedDeg(deg: number): number {
  return ((((deg + 180) % 360) + 360) % 360) - 180;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What goes into a joint pivots in the hole of its portal: where a hand wants its tip, from how deep it
// is and how it leans. Pure.
import type { Vec3 } from "../protocol";
import { add, cross, dot, length, normalized, rotated, scaled, subtract } from "../tool_placement";

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
/** A wish goes no farther beyond where the tip really is: enough to be felt [mm]. */
const MOST_PRESSED_MM = 2.5;
/** The same to the side, where something holds the tip, while the hand goes on: without feeling it levers hard
 * enough to do harm, and no harder. Once it stops it gives way. */
const MOST_LEVERED_MM = 5;
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

/** A hand that presses against what does not yield: it goes no deeper than a little beyond the tip, nor
 * far to its side. @param forceN  on the hand @param goesOn  it is being leaned */
export function heldBack(
  lean: Lean,
  tipMm: Vec3,
  portal: PortalNow,
  { forceN, goesOn }: { readonly forceN: number; readonly goesOn: boolean },
): Lean {
  const most = length(subtract(tipMm, portal.skinMm)) + MOST_PRESSED_MM;
  const back = lean.depthMm <= most ? lean : { ...lean, depthMm: most };
  const aside = subtract(wishOf(back, portal).tipMm, tipMm);
  const far = length(aside);
  const allowed = goesOn ? MOST_LEVERED_MM : MOST_PRESSED_MM;
  if (forceN < HELD_N || far <= allowed) return back;
  return leanAt(add(tipMm, scaled(aside, allowed / far)), portal);
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

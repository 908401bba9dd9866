// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a view is called by its angles.
import type { NamedView } from "../protocol";

/** Angles nearer than this are the named view [deg]. */
const SAME_DEG = 0.5;

export function viewName(
  views: readonly NamedView[],
  rotationDeg: number,
  tiltDeg: number,
): string {
  const named = views.find(
    (view) =>
      Math.abs(view.rotation_deg - rotationDeg) < SAME_DEG &&
      Math.abs(view.tilt_deg - tiltDeg) < SAME_DEG,
  );
  return named?.label ?? `${signed(rotationDeg)} / ${signed(tiltDeg)}`;
}

/** The same in as little width as a small picture has: angles below each other. */
export function narrowViewName(
  views: readonly NamedView[],
  rotationDeg: number,
  tiltDeg: number,
): string {
  return viewName(views, rotationDeg, tiltDeg).replace(" / ", "\n");
}

/** "+15°", "-30°", "0°". */
export function signed(degrees: number): string {
  const whole = Math.round(degrees);
  return `${whole > 0 ? "+" : whole < 0 ? "−" : ""}${Math.abs(whole)}°`;
}

/** Wraps a rotation to (-180, 180]. */
export function wrapped(degrees: number): number {
  const turned = ((degrees % 360) + 360) % 360;
  return turned > 180 ? turned - 360 : turned;
}

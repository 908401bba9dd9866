// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluid in the joint as the page sets it and tells of it, and where its bubbles collect.
import type { FluidControl, JointFluid, Vec3 } from "../protocol";

export type FluidAct = "more" | "less" | "outflow" | "flush" | "dry";

export interface FluidSetting {
  readonly control: FluidControl;
  readonly value: number;
}

/** What an act asks for now; undefined where it goes no further. */
export function settingOf(act: FluidAct, now: JointFluid): FluidSetting | undefined {
  const inflow = (by: number): FluidSetting | undefined => {
    const to = now.inflow_mmhg + by * now.step_mmhg;
    if (to < 0 || to > now.most_inflow_mmhg) return undefined;
    return { control: "inflow", value: Math.round(to / now.step_mmhg) };
  };
  switch (act) {
    case "more":
      return inflow(1);
    case "less":
      return inflow(-1);
    case "outflow":
      return { control: "outflow", value: now.outflow_open ? 0 : 1 };
    case "flush":
      return { control: "flush", value: 0 };
    case "dry":
      return { control: "dry", value: now.dry ? 0 : 1 };
  }
}

/** As the pump and the taps show it: how clear the picture is a person sees. */
export function fluidWords(now: JointFluid): string {
  const flush = now.flushing ? " · flushing" : "";
  if (now.dry) return `Dry, no fluid${flush}`;
  return (
    `Pump ${now.inflow_mmhg} mmHg · joint ${now.pressure_mmhg} mmHg · ` +
    `outflow ${now.outflow_open ? "open" : "closed"}${flush}`
  );
}

/** So far before the lens bubbles are drawn [mm]. */
const NEAREST_MM = 2.5;
const FARTHEST_MM = 11;
/** So far below the highest place that is seen they still lie [mm], if that is above the lens. */
const LAYER_MM = 2.2;
const ABOVE_MM = 0.5;
const APART_MM = 0.7;

export interface BubbleView {
  readonly eyeMm: Vec3;
  readonly axis: Vec3;
  /** Unit, up in the room. */
  readonly high: Vec3;
  readonly halfFieldRad: number;
}

/**
 * Where bubbles lie: under the roof of what the scope sees. Who looks down sees none.
 * @param walls  x, y, z of the joint's wall
 */
export function highestPlaces(walls: ArrayLike<number>, view: BubbleView, most: number): Vec3[] {
  const cosine = Math.cos(view.halfFieldRad);
  let top = -Infinity;
  const seen: { readonly at: Vec3; readonly high: number }[] = [];
  for (let i = 0; i + 2 < walls.length; i += 3) {
    const at: Vec3 = [walls[i] ?? 0, walls[i + 1] ?? 0, walls[i + 2] ?? 0];
    const to: Vec3 = [at[0] - view.eyeMm[0], at[1] - view.eyeMm[1], at[2] - view.eyeMm[2]];
    const far = Math.hypot(...to);
    if (far > FARTHEST_MM) continue;
    const high = to[0] * view.high[0] + to[1] * view.high[1] + to[2] * view.high[2];
    if (far < NEAREST_MM || high < ABOVE_MM) continue;
    const along = to[0] * view.axis[0] + to[1] * view.axis[1] + to[2] * view.axis[2];
    if (along <= cosine * far) continue;
    top = Math.max(top, high);
    seen.push({ at, high });
  }
  const places: Vec3[] = [];
  const layer = seen.filter(({ high }) => high >= top - LAYER_MM);
  for (const { at } of layer.sort((a, b) => b.high - a.high)) {
    if (places.length >= most) break;
    const isFree = places.every(
      (other) => Math.hypot(at[0] - other[0], at[1] - other[1], at[2] - other[2]) >= APART_MM,
    );
    if (isFree) places.push(at);
  }
  return places;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two points on a picture and how far apart they are in the patient. A cone beam magnifies what is nearer to
// its source: the length holds for what lies in the plane of the isocentre, at right angles to the beam.
import type { CArmPicture } from "../protocol";

/** Source to receptor over source to isocentre, of the host's C-arm (src/fluoroscopy/c_arm.hpp). */
const MAGNIFICATION = 450 / 360;
const FAR_PX = 20;

/** As shares of the picture's side, from its top left corner. */
export interface PicturePoint {
  readonly x: number;
  readonly y: number;
}

/** No point yet, one, or both. */
export type Ruler = readonly PicturePoint[];

/** A third point begins anew. */
export function withPoint(ruler: Ruler, point: PicturePoint): Ruler {
  return ruler.length === 1 ? [...ruler, point] : [point];
}

/** Where the ruler's cross is by keys, moved by shares of the side and kept on the picture. */
export function nudgedPoint(point: PicturePoint, right: number, down: number): PicturePoint {
  const kept = (value: number): number => Math.min(1, Math.max(0, value));
  return { x: kept(point.x + right), y: kept(point.y + down) };
}

/** What an arrow key moves the cross by, in pixels of the picture: fine, with Shift far. */
export function keyStep(
  key: string,
  isFar: boolean,
): { readonly right: number; readonly down: number } | undefined {
  const step = isFar ? FAR_PX : 1;
  switch (key) {
    case "ArrowLeft":
      return { right: -step, down: 0 };
    case "ArrowRight":
      return { right: step, down: 0 };
    case "ArrowUp":
      return { right: 0, down: -step };
    case "ArrowDown":
      return { right: 0, down: step };
    default:
      return undefined;
  }
}

export function rulerText(mm: number): string {
  return `${mm.toFixed(1)} mm at the isocentre`;
}

/** At the isocentre [mm]; nothing before the second point. */
export function rulerMm(
  ruler: Ruler,
  { width, mmPerPixel }: Pick<CArmPicture, "width" | "mmPerPixel">,
): number | undefined {
  const [from, to] = ruler;
  if (from === undefined || to === undefined) return undefined;
  const share = Math.hypot(to.x - from.x, to.y - from.y);
  return (share * width * mmPerPixel) / MAGNIFICATION;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The line by which a bone is cut: it stands for the plane through its ends along the view, which goes on beyond
// them. What lies to the right of who walks along it, seen on the screen, is cut off.
import type { Vec3 } from "../protocol";
import { along, cross, dot, type Plane } from "./planes_model";
import { pixelOf, type SliceView } from "./slice_model";

export interface CutLine {
  /** Patient mm. */
  readonly a: Vec3;
  readonly b: Vec3;
  /** Into the screen on which it was drawn, a unit vector of Patient. */
  readonly away: Vec3;
}

/** Ends closer than this, seen along the view, make no line [mm] [E]. */
const SHORTEST_MM = 1;

export type Pixel = readonly [number, number];

/** Towards what is cut off; not of unit length. */
export const cutNormal = ({ a, b, away }: CutLine): Vec3 => cross(away, along(b, -1, a));

export function isLongEnough(line: CutLine): boolean {
  // As long as the line is across the view: `away` is a unit vector.
  const n = cutNormal(line);
  return dot(n, n) >= SHORTEST_MM ** 2;
}

export interface CutTrace {
  /** Where the plane passes through the picture, from far beyond one edge to far beyond the other. */
  readonly from: Pixel;
  readonly to: Pixel;
  /** Towards what is cut off, one pixel long. */
  readonly side: Pixel;
  /** The ends, where this is a picture on which it could have been drawn. */
  readonly ends: readonly [Pixel, Pixel] | undefined;
}

/** @return undefined where the picture lies along the plane, and the plane nowhere in it */
export function traceOfCut(
  line: CutLine,
  view: SliceView,
  width: number,
  height: number,
): CutTrace | undefined {
  const { plane }: { readonly plane: Plane } = view;
  const n = cutNormal(line);
  const [nx, ny] = [dot(n, plane.right), dot(n, plane.down)];
  const across = Math.hypot(nx, ny);
  const whole = Math.sqrt(dot(n, n));
  // A plane at less than a degree to the picture is not told from it.
  if (!(whole > 0) || !(across > 0.02 * whole)) return undefined;
  const side: Pixel = [nx / across, ny / across];
  // The picture's middle is off the plane by so much, measured in the picture.
  const off = dot(along(view.centre, -1, line.a), n) / across / view.mmPerPixel;
  const foot: Pixel = [width / 2 - off * side[0], height / 2 - off * side[1]];
  const reach = width + height + Math.abs(off);
  const isHome = dot(plane.away, line.away) > 0.999;
  return {
    from: [foot[0] + reach * side[1], foot[1] - reach * side[0]],
    to: [foot[0] - reach * side[1], foot[1] + reach * side[0]],
    side,
    ends: isHome
      ? [pixelOf(view, width, height, line.a), pixelOf(view, width, height, line.b)]
      : undefined,
  };
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The force on a hand as an arrow: right and up as on the screen; what points away or nearer is a ring.
import type { HandDevice } from "../protocol";
import { forceArrow } from "./device_model";

const SVG = "http://www.w3.org/2000/svg";
const RADIUS = 26;
const HEAD = 6;
/** Shorter than this is no direction. */
const LEAST = 0.01;

function part(name: string, attributes: Readonly<Record<string, string>>): SVGElement {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

export class ForceDial {
  readonly element = part("svg", {
    class: "device-dial",
    viewBox: "-30 -30 60 60",
    "aria-hidden": "true",
  });
  private readonly arrow = part("path", { class: "arrow" });
  private readonly ring = part("circle", { class: "ring", r: "0" });

  constructor() {
    this.element.append(
      part("circle", { class: "rim", r: String(RADIUS) }),
      this.ring,
      this.arrow,
      part("circle", { class: "middle", r: "1.5" }),
    );
  }

  show(device: HandDevice): void {
    const { x, y, depth } = forceArrow(device);
    const size = Math.hypot(x, y);
    this.ring.setAttribute("r", (RADIUS * Math.min(1, depth)).toFixed(1));
    if (size < LEAST) {
      this.arrow.setAttribute("d", "");
      return;
    }
    const [ex, ey] = [RADIUS * x, -RADIUS * y];
    const [ux, uy] = [x / size, -y / size];
    const head = Math.min(HEAD, RADIUS * size);
    const point = (along: number, aside: number): string =>
      `${(ex - ux * along - uy * aside).toFixed(1)} ${(ey - uy * along + ux * aside).toFixed(1)}`;
    this.arrow.setAttribute(
      "d",
      `M0 0L${point(0, 0)}M${point(head, head / 2)}L${point(0, 0)}L${point(head, -head / 2)}`,
    );
  }
}

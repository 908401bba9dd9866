// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A graphics card that is reset, or is wanted elsewhere, takes what a page has drawn: until it gives it back
// the canvas is black, and whoever works by it has to know why.
import { make } from "./element";

/**
 * What is said over a canvas while its graphics are lost; nothing while they are there.
 * @param onBack  what was drawn is gone, and can be drawn again
 */
export function lostPicture(canvas: HTMLCanvasElement, onBack: () => void): HTMLElement {
  const said = make(
    "p.lost-picture",
    { role: "alert" },
    "The graphics card has let go of this picture. It comes back by itself; if it does not, load the page anew.",
  );
  said.hidden = true;
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault(); // else it never comes back
    said.hidden = false;
  });
  canvas.addEventListener("webglcontextrestored", () => {
    said.hidden = true;
    onBack();
  });
  return said;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture as a PNG file in the person's downloads, with its text in it.
import { make } from "../dom";
import type { CArmPicture } from "../protocol";
import { drawPicture, drawRuler, type Overlay } from "./picture_canvas";
import { pictureFileName } from "./picture_file_model";
import type { Ruler } from "./ruler_model";

/** Twice the receptor's pixels, so that the text is sharp. */
const SIDE_PX = 1024;

export function savePicture(
  picture: CArmPicture,
  inverted: boolean,
  overlay: Overlay,
  ruler: Ruler,
  patient: string,
): void {
  const canvas = make("canvas", { width: String(SIDE_PX), height: String(SIDE_PX) });
  const taken = new Date().toLocaleString();
  drawPicture(canvas, picture, inverted, { ...overlay, lines: [patient, `Carpus, ${taken}`] });
  drawRuler(canvas, picture, ruler);
  canvas.toBlob((file) => {
    if (file === null) return;
    const address = URL.createObjectURL(file);
    const name = pictureFileName(patient, picture.shot, overlay.view);
    make("a", { href: address, download: name }).click();
    // The download has begun by then.
    setTimeout(() => {
      URL.revokeObjectURL(address);
    }, 10_000);
  }, "image/png");
}

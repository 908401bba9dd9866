// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One fluoroscopy picture on a canvas: round field, soft edge, text in the corners as a mini C-arm
// writes it. The grey is the host's; here it is only turned over on request.
import type { CArmPicture } from "../protocol";

export interface Overlay {
  readonly view: string;
  readonly kv: string;
}

/** Free corners for the text: the field does not reach the border. */
const FIELD_RADIUS = 0.492;
/** Where the soft edge of the field begins, as a share of its radius. */
const SOFT_EDGE = 0.965;

const plate = document.createElement("canvas");

/** Draws the picture into the whole canvas, at the canvas's own resolution. */
export function drawPicture(
  canvas: HTMLCanvasElement,
  picture: CArmPicture | undefined,
  inverted: boolean,
  overlay: Overlay | undefined,
): void {
  const context = canvas.getContext("2d");
  if (context === null) return;
  const side = canvas.width;
  context.globalCompositeOperation = "source-over";
  context.fillStyle = "#05080a";
  context.fillRect(0, 0, side, side);
  if (picture === undefined) return;
  fillPlate(picture, inverted);
  const radius = FIELD_RADIUS * side;
  context.save();
  context.beginPath();
  context.arc(side / 2, side / 2, radius, 0, 2 * Math.PI);
  context.clip();
  context.imageSmoothingQuality = "high";
  context.drawImage(plate, 0, 0, side, side);
  const edge = context.createRadialGradient(
    side / 2,
    side / 2,
    radius * 0.55,
    side / 2,
    side / 2,
    radius,
  );
  edge.addColorStop(0, "rgba(5, 8, 10, 0)");
  edge.addColorStop(0.8, "rgba(5, 8, 10, 0.1)");
  edge.addColorStop(SOFT_EDGE, "rgba(5, 8, 10, 0.28)");
  edge.addColorStop(1, "rgba(5, 8, 10, 1)");
  context.fillStyle = edge;
  context.fillRect(0, 0, side, side);
  context.restore();
  if (overlay !== undefined) write(context, side, picture, overlay);
}

function fillPlate(picture: CArmPicture, inverted: boolean): void {
  plate.width = picture.width;
  plate.height = picture.height;
  const context = plate.getContext("2d");
  if (context === null) return;
  const image = context.createImageData(picture.width, picture.height);
  const flip = inverted ? 255 : 0;
  for (let i = 0; i < picture.grey.length; ++i) {
    const grey = (picture.grey[i] ?? 0) ^ flip;
    const at = 4 * i;
    image.data[at] = image.data[at + 1] = image.data[at + 2] = grey;
    image.data[at + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}

function write(
  context: CanvasRenderingContext2D,
  side: number,
  picture: CArmPicture,
  overlay: Overlay,
): void {
  const size = Math.max(11, Math.round(side / 30));
  const margin = Math.round(size * 0.7);
  context.font = `600 ${size}px 'Inter Variable', sans-serif`;
  context.fillStyle = "#dfe7ea";
  context.textBaseline = "top";
  context.textAlign = "left";
  context.fillText(overlay.view, margin, margin);
  context.textAlign = "right";
  const number = picture.kind === "live" ? "" : `#${picture.shot}`;
  context.fillText(number, side - margin, margin);
  context.textBaseline = "bottom";
  context.font = `400 ${Math.round(size * 0.86)}px 'Inter Variable', sans-serif`;
  context.fillStyle = "#9fb0b7";
  context.textAlign = "left";
  context.fillText(overlay.kv, margin, side - margin);
  context.textAlign = "right";
  context.fillText(`${picture.doseCgyCm2.toFixed(2)} cGy cm²`, side - margin, side - margin);
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One fluoroscopy picture on a canvas: round field, soft edge, text in the corners as a mini C-arm
// writes it. The grey is the host's; here it is only turned over on request.
import type { CArmPicture } from "../protocol";
import { rulerMm, rulerText, type PicturePoint, type Ruler } from "./ruler_model";

export interface Overlay {
  readonly view: string;
  /** Below the view: whose picture, when; of one that leaves the page. */
  readonly lines?: readonly string[];
}

/** Free corners for the text: the field does not reach the border. */
const FIELD_RADIUS = 0.492;
/** Where the soft edge of the field begins, as a share of its radius. */
const SOFT_EDGE = 0.965;

const RULER_COLOR = "#5cc8ff";

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
  context.textBaseline = "top";
  (overlay.lines ?? []).forEach((line, index) => {
    context.fillText(line, margin, margin + (index + 1.3) * size);
  });
  context.textBaseline = "bottom";
  context.fillText(`${Math.round(picture.tubeKv)} kV`, margin, side - margin);
  context.textAlign = "right";
  context.fillText(`${picture.doseCgyCm2.toFixed(2)} cGy cm²`, side - margin, side - margin);
}

/** Draws where the next point of the ruler goes: a cross through the whole field. */
export function drawCross(canvas: HTMLCanvasElement, { x, y }: PicturePoint): void {
  const context = canvas.getContext("2d");
  if (context === null) return;
  const side = canvas.width;
  context.strokeStyle = RULER_COLOR;
  context.lineWidth = Math.max(1, side / 700);
  context.setLineDash([side / 80, side / 80]);
  context.beginPath();
  context.moveTo(0, y * side);
  context.lineTo(side, y * side);
  context.moveTo(x * side, 0);
  context.lineTo(x * side, side);
  context.stroke();
  context.setLineDash([]);
}

/** Draws what is measured over the picture. */
export function drawRuler(canvas: HTMLCanvasElement, picture: CArmPicture, ruler: Ruler): void {
  const context = canvas.getContext("2d");
  const [from, to] = ruler;
  if (context === null || from === undefined) return;
  const side = canvas.width;
  const thin = Math.max(1.5, side / 400);
  const arm = side / 60;
  context.strokeStyle = context.fillStyle = RULER_COLOR;
  context.lineWidth = thin;
  context.beginPath();
  for (const { x, y } of ruler) {
    context.moveTo(x * side - arm, y * side);
    context.lineTo(x * side + arm, y * side);
    context.moveTo(x * side, y * side - arm);
    context.lineTo(x * side, y * side + arm);
  }
  if (to !== undefined) {
    context.moveTo(from.x * side, from.y * side);
    context.lineTo(to.x * side, to.y * side);
  }
  context.stroke();
  const mm = rulerMm(ruler, picture);
  if (mm === undefined || to === undefined) return;
  const size = Math.max(12, Math.round(side / 28));
  const text = rulerText(mm);
  context.font = `600 ${size}px 'Inter Variable', sans-serif`;
  const wide = context.measureText(text).width + size;
  // Beside the second point, wholly on the picture.
  const x = Math.min(side - wide - arm, Math.max(arm, to.x * side - wide / 2));
  const y = Math.min(side - 4 * size, to.y * side + 1.5 * arm);
  context.fillStyle = "rgba(5, 8, 10, 0.78)";
  context.fillRect(x, y, wide, 1.5 * size);
  context.fillStyle = RULER_COLOR;
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillText(text, x + size / 2, y + 0.78 * size);
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The binary frame of one C-arm picture (protocol/README.md).
import type { Parsed } from "./validator";

/** A single shot; one pulse of a live look; the last pulse of one, held; of the view quiz. */
export type PictureKind = "shot" | "live" | "held" | "quiz";
const KINDS: readonly PictureKind[] = ["shot", "live", "held", "quiz"];

export interface CArmPicture {
  readonly kind: PictureKind;
  /** Its number; 0 while live; of the quiz the question's. */
  readonly shot: number;
  readonly width: number;
  readonly height: number;
  readonly mmPerPixel: number;
  readonly rotationDeg: number;
  readonly tiltDeg: number;
  readonly doseCgyCm2: number;
  readonly tubeKv: number;
  /** Grey, row by row from the top. */
  readonly grey: Uint8Array;
}

const HEADER_BYTES = 40;
const VERSION = 3;
/** No receptor of a mini C-arm has more; a larger picture is a broken frame. */
const MAX_SIDE = 4096;

function refuse(reason: string): { ok: false; reason: string } {
  return { ok: false, reason: `C-arm picture: ${reason}` };
}

/** Reads one binary frame; never throws. */
export function parseCArmPicture(buffer: ArrayBuffer): Parsed<CArmPicture> {
  if (buffer.byteLength < HEADER_BYTES) return refuse(`${buffer.byteLength} bytes are no header`);
  const view = new DataView(buffer);
  if (view.getUint32(0, false) !== 0x4341524d) return refuse("it does not begin with CARM");
  const version = view.getUint32(4, true);
  if (version !== VERSION) return refuse(`version ${version}, this page reads ${VERSION}`);
  const kind = KINDS[view.getUint32(8, true)];
  if (kind === undefined) return refuse(`no such kind as ${view.getUint32(8, true)}`);
  const width = view.getUint16(16, true);
  const height = view.getUint16(18, true);
  if (width === 0 || height === 0 || width > MAX_SIDE || height > MAX_SIDE) {
    return refuse(`${width} x ${height} pixels`);
  }
  if (buffer.byteLength !== HEADER_BYTES + width * height) {
    return refuse(`${buffer.byteLength} bytes for ${width} x ${height} pixels`);
  }
  const picture: CArmPicture = {
    kind,
    shot: view.getUint32(12, true),
    width,
    height,
    mmPerPixel: view.getFloat32(20, true),
    rotationDeg: view.getFloat32(24, true),
    tiltDeg: view.getFloat32(28, true),
    doseCgyCm2: view.getFloat32(32, true),
    tubeKv: view.getFloat32(36, true),
    grey: new Uint8Array(buffer, HEADER_BYTES),
  };
  const { doseCgyCm2, mmPerPixel, rotationDeg, tiltDeg, tubeKv } = picture;
  const figures = [mmPerPixel, rotationDeg, tiltDeg, doseCgyCm2, tubeKv];
  if (!figures.every(Number.isFinite)) return refuse("a figure of the header is not finite");
  return { ok: true, value: picture };
}

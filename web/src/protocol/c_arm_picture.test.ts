// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A good frame is read whole; every broken one is refused with its reason.
import { describe, expect, it } from "vitest";
import { parseCArmPicture } from "./c_arm_picture";

function frame(width: number, height: number, pixels = width * height): DataView {
  const view = new DataView(new ArrayBuffer(40 + pixels));
  view.setUint32(0, 0x4341524d, false);
  view.setUint32(4, 3, true);
  view.setUint32(8, 2, true);
  view.setUint32(12, 7, true);
  view.setUint16(16, width, true);
  view.setUint16(18, height, true);
  view.setFloat32(20, 0.25, true);
  view.setFloat32(24, 45, true);
  view.setFloat32(28, -10, true);
  view.setFloat32(32, 0.5, true);
  view.setFloat32(36, 50, true);
  for (let i = 0; i < pixels; ++i) view.setUint8(40 + i, i % 256);
  return view;
}

describe("parseCArmPicture", () => {
  it("reads every field of a good frame", () => {
    const parsed = parseCArmPicture(frame(3, 2).buffer as ArrayBuffer);
    expect(parsed).toMatchObject({
      ok: true,
      value: {
        kind: "held",
        shot: 7,
        width: 3,
        height: 2,
        mmPerPixel: 0.25,
        rotationDeg: 45,
        tiltDeg: -10,
        tubeKv: 50,
      },
    });
    expect(parsed.ok && [...parsed.value.grey]).toEqual([0, 1, 2, 3, 4, 5]);
  });

  it.each([
    ["too short", () => new DataView(new ArrayBuffer(39))],
    ["pixels missing", () => frame(3, 2, 5)],
    ["pixels too many", () => frame(3, 2, 7)],
    ["no pixels", () => frame(0, 2)],
    ["another kind", () => frameWith((v) => v.setUint8(0, 0x42))],
    ["another version", () => frameWith((v) => v.setUint32(4, 1, true))],
    ["an unknown kind", () => frameWith((v) => v.setUint32(8, 4, true))],
    ["a figure that is no number", () => frameWith((v) => v.setFloat32(24, NaN, true))],
  ])("refuses %s", (_name, make) => {
    const parsed = parseCArmPicture(make().buffer as ArrayBuffer);
    expect(parsed.ok).toBe(false);
    expect(!parsed.ok && parsed.reason).toMatch(/^C-arm picture: /);
  });
});

function frameWith(change: (view: DataView) => void): DataView {
  const view = frame(3, 2);
  change(view);
  return view;
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../protocol";
import { placeOfLabel } from "./label_place_model";
import { measureText } from "./measure_model";
import {
  applied,
  heldInside,
  inverted,
  middleOf,
  parseNifti,
  voxelIndexAt,
  type Volume,
} from "./nifti_model";
import { cross, dot, PLANE_IDS, planesOf } from "./planes_model";
import { boneTitle, labelColors, parseScannedCase, withTrust } from "./scan_case_model";
import { drawGrey, drawLabels, pixelOf, placeAt, type SliceView } from "./slice_model";
import { draggedWindow, windowText } from "./window_model";

const SIZE = [4, 3, 2] as const;

/** 4 x 3 x 2 voxels of 0.5 x 1 x 2 mm; RAS rows as a case's file has them. */
function nifti(type: 2 | 4, value: (i: number) => number): ArrayBuffer {
  const bytes = new ArrayBuffer(352 + 24 * (type === 4 ? 2 : 1));
  const view = new DataView(bytes);
  view.setInt32(0, 348, true);
  SIZE.forEach((n, i) => {
    view.setInt16(42 + 2 * i, n, true);
  });
  view.setInt16(70, type, true);
  view.setFloat32(108, 352, true);
  view.setInt16(254, 2, true);
  [-0.5, 0, 0, -10, 0, -1, 0, -20, 0, 0, 2, 30].forEach((v, i) => {
    view.setFloat32(280 + 4 * i, v, true);
  });
  view.setUint32(344, 0x6e2b3100);
  for (let i = 0; i < 24; ++i) {
    if (type === 4) view.setInt16(352 + 2 * i, value(i), true);
    else view.setUint8(352 + i, value(i));
  }
  return bytes;
}

const ct = (): Volume => parseNifti(nifti(4, (i) => 100 * i - 1000));

describe("a volume of a case", () => {
  it("is read with its values and its place in the patient", () => {
    const volume = ct();
    expect(volume.size).toEqual([4, 3, 2]);
    expect(volume.values[0]).toBe(-1000);
    expect(volume.values[23]).toBe(1300);
    expect(applied(volume.patientFromVoxel, [1, 1, 1])).toEqual([10.5, 21, 32]);
    expect(voxelIndexAt(volume, [10.6, 21.2, 32.4])).toBe(17);
    expect(voxelIndexAt(volume, [9.7, 21, 32])).toBe(-1);
  });
  it("is refused where it is cut off, of another kind, or has no size or place", () => {
    const whole = nifti(4, () => 0);
    expect(() => parseNifti(whole.slice(0, 300))).toThrow("cut off");
    expect(() => parseNifti(whole.slice(0, -1))).toThrow("cut off");
    for (const [at, value, why] of [
      [0, 540, "no NIfTI-1"],
      [42, 0, "no size"],
      [42, -3, "no size"],
      [70, 16, "type 16"],
      [254, 0, "where it lies"],
    ] as const) {
      const bad = whole.slice(0);
      new DataView(bad).setInt16(at, value, true);
      expect(() => parseNifti(bad)).toThrow(why);
    }
    const flat = whole.slice(0);
    new DataView(flat).setFloat32(280, 0, true);
    expect(() => parseNifti(flat)).toThrow("flat");
  });
  it("has a place of each label in that label, and none of others", () => {
    const labels = parseNifti(nifti(2, (i) => (i % 4 === 1 || i === 12 ? 7 : 0)));
    const place = placeOfLabel(labels, 7);
    expect(place && labels.values[voxelIndexAt(labels, place)]).toBe(7);
    expect(placeOfLabel(labels, 3)).toBeUndefined();
  });
  it("has a middle, and holds what is led out of it", () => {
    expect(middleOf(ct())).toEqual([10.75, 21, 31]);
    const close = (mm: Vec3, to: Vec3): void => {
      mm.forEach((v, i) => {
        expect(v).toBeCloseTo(to[i] ?? NaN, 6);
      });
    };
    close(heldInside(ct(), [10.6, 21.2, 30.7]), [10.6, 21.2, 30.7]);
    close(heldInside(ct(), [50, 21.2, -50]), [11.5, 21.2, 30]);
  });
  it("inverts what is oblique", () => {
    const m = [0.3, 0.1, 0, 5, -0.1, 0.3, 0.2, 6, 0, -0.1, 0.5, 7];
    const back = applied(inverted(m), applied(m, [3, 4, 5]));
    [3, 4, 5].forEach((v, i) => {
      expect(back[i]).toBeCloseTo(v, 10);
    });
  });
});

describe("planes", () => {
  const wrist: readonly Vec3[] = [
    [0, 0, -1],
    [1, 0, 0],
    [0, -1, 0],
  ];
  it("are right-handed and away from the reader", () => {
    for (const alignment of ["wrist", "scan"] as const) {
      const planes = planesOf(alignment, wrist, "left");
      for (const id of PLANE_IDS) {
        const { right, down, away } = planes[id];
        expect(dot(right, down)).toBeCloseTo(0);
        expect(cross(right, down)).toEqual(away);
      }
    }
  });
  it("show a coronal slice as a PA film: distal up, a left thumb on the right", () => {
    const { coronal } = planesOf("wrist", wrist, "left");
    expect(coronal.down).toEqual(wrist[0]);
    expect(coronal.words.right).toBe("Radial");
    expect(planesOf("wrist", wrist, "right").coronal.words.right).toBe("Ulnar");
    expect(coronal.away).toEqual([0, -1, 0]); // from dorsal to volar
  });
  it("show what was scanned by radiological convention", () => {
    const { axial } = planesOf("scan", wrist, "left");
    expect([axial.words.left, axial.words.down]).toEqual(["Right", "Posterior"]);
  });
});

describe("a slice", () => {
  const volume = ct();
  const plane = planesOf("scan", [], "left").axial;
  const view: SliceView = { plane, centre: [10.75, 21, 30], mmPerPixel: 0.5 };
  const paint = (): Uint32Array => {
    const out = new Uint32Array(8 * 8);
    drawGrey(volume, view, { centre: 0, width: 2550 }, 8, 8, out);
    return out;
  };
  it("takes places to pixels and back", () => {
    const mm = placeAt(view, 8, 8, 2.5, 6);
    expect(pixelOf(view, 8, 8, mm)).toEqual([2.5, 6]);
  });
  it("has the CT's values at the voxels' middles and between them what lies between", () => {
    const out = paint();
    const at = (mm: Vec3): number => {
      const [x, y] = pixelOf(view, 8, 8, mm);
      return (out[Math.floor(y) * 8 + Math.floor(x)] ?? 0) & 255;
    };
    // In the middle of a pixel: voxel (1.5, 1, 0) has -1000 + 100 (4 + 1.5).
    const between = placeAt(view, 8, 8, 4.5, 3.5);
    const voxel = applied(volume.voxelFromPatient, between);
    const hu = -1000 + 100 * (voxel[0] + 4 * voxel[1]);
    expect(at(between)).toBe(Math.trunc((hu + 1275) / 10));
  });
  it("shows nothing beyond the scan", () => {
    expect((paint()[0] ?? 0) >>> 0).toBe(0xff14100e);
  });
  it("fills labels faintly, draws their rims strongly, and leaves the rest", () => {
    const labels = parseNifti(nifti(2, (i) => (i < 12 && i % 4 < 2 ? 1 : 0)));
    const colors = new Uint32Array(256).fill(0x0000ff);
    const out = new Uint32Array(64).fill(0xff000000);
    drawLabels(labels, view, { colors, opacity: 0.5 }, 8, 8, out);
    const shades = new Set([...out].map((pixel) => pixel & 255));
    expect([...shades].sort((a, b) => a - b)).toEqual([0, 127, 229]);
    const untouched = new Uint32Array(64).fill(5);
    drawLabels(labels, view, { colors, opacity: 0 }, 8, 8, untouched);
    expect(new Set(untouched)).toEqual(new Set([5]));
  });
});

describe("windows and measures", () => {
  it("are dragged: wider to the right, brighter down, within bounds", () => {
    const from = { centre: 500, width: 2000 };
    expect(draggedWindow(from, 10, 10)).toEqual({ centre: 450, width: 2050 });
    expect(draggedWindow(from, -1e9, 0).width).toBe(10);
    expect(windowText(from)).toBe("Bone: centre 500, width 2000 HU");
  });
  it("are of space", () => {
    const places: readonly Vec3[] = [
      [3, 0, 0],
      [0, 0, 0],
      [0, 0, 4],
    ];
    expect(measureText({ kind: "distance", places: [places[0] ?? [0, 0, 0], [0, 0, 4]] })).toBe(
      "5.0 mm",
    );
    expect(measureText({ kind: "angle", places })).toBe("90.0°");
    expect(measureText({ kind: "angle", places: places.slice(0, 2) })).toBe("");
    expect(
      measureText({
        kind: "angle",
        places: [
          [1, 1, 1],
          [1, 1, 1],
          [2, 0, 0],
        ],
      }),
    ).toBe("");
  });
});

describe("what the case tells", () => {
  const rotation = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  const json = {
    format: "carpus case",
    pseudonym: "w",
    side: "right",
    provenance: { simulated: true },
    wrist_from_patient: { rotation },
    bones: [
      { name: "radius", label: 1 },
      { name: "pisiform", label: 6 },
    ],
  };
  const trust = {
    format: "carpus bone trust",
    schema_version: 1,
    bones: [{ name: "pisiform", confidence: 0.31, flagged: true, why: "Volume is low." }],
  };
  it("is taken with what is known of how sure it is", () => {
    const told = parseScannedCase(JSON.stringify(json));
    expect(told.bones[1]?.confidence).toBeUndefined();
    expect(() => withTrust(told, "{}")).toThrow("reconstruct");
    const parsed = withTrust(told, JSON.stringify(trust));
    expect(parsed.bones[1]?.confidence).toBe(0.31);
    expect(parsed.bones[1]?.flagged).toBe(true);
    expect(parsed.bones[0]).toEqual({
      name: "radius",
      label: 1,
      confidence: undefined,
      flagged: false,
      why: "",
    });
    expect(parsed.bones[1]?.why).toBe("Volume is low.");
  });
  it("has warnings of the whole scan as sentences", () => {
    const told = parseScannedCase(JSON.stringify(json));
    expect(told.warnings).toEqual([]);
    expect(withTrust(told, JSON.stringify(trust)).warnings).toEqual([]);
    const small = {
      ...trust,
      of_scan: ["the wrist is 70 % of an adult's size. If …, do not use it", 3],
    };
    expect(withTrust(told, JSON.stringify(small)).warnings).toEqual([
      "The wrist is 70 % of an adult's size. If …, do not use it.",
    ]);
  });
  it("is refused where it is no case", () => {
    for (const bad of [
      {},
      { ...json, format: "x" },
      { ...json, bones: [{}] },
      { ...json, wrist_from_patient: 1 },
    ]) {
      expect(() => parseScannedCase(JSON.stringify(bad))).toThrow();
    }
  });
  it("has words and colours for bones", () => {
    expect(boneTitle("scaphoid_proximal")).toBe("Scaphoid, proximal part");
    expect(boneTitle("metacarpal1")).toBe("Metacarpal 1");
    const colors = labelColors();
    expect(new Set(colors.slice(1, 17)).size).toBe(16);
  });
});

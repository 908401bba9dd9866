// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { inverted, type Volume } from "./nifti_model";
import { labelAt, readingAt } from "./reading_model";

const rows = [1, 0, 0, -5, 0, 1, 0, 0, 0, 0, 1, 0];
const volume = (values: Int16Array | Uint8Array): Volume => ({
  size: [4, 1, 1],
  patientFromVoxel: rows,
  voxelFromPatient: inverted(rows),
  values,
  head: new Uint8Array(352),
});
const ct = volume(Int16Array.of(-1000, 40, 700, 1200));
const labels = volume(Uint8Array.of(0, 15, 3, 16));

describe("what lies under the pointer", () => {
  it("is said, a bone too that the case did not have and a person painted", () => {
    expect(readingAt(ct, labels, [-4, 0, 0], () => 1)).toBe(
      "40 HU · Metacarpal 5 · -4.0, 0.0, 0.0 mm",
    );
    expect(readingAt(ct, labels, [-5, 0, 0], () => 1)).toContain("-1000 HU · no bone");
    expect(readingAt(ct, labels, [-9, 0, 0], () => 1)).toBe("outside the scan");
    expect(readingAt(ct, undefined, [-4, 0, 0], () => 0)).toContain("no bone");
  });
  it("is a part of the scaphoid where there are two", () => {
    const count = (label: number): number => (label === 16 ? 0 : 1);
    expect(readingAt(ct, labels, [-3, 0, 0], count)).toContain("· Scaphoid ·");
    expect(readingAt(ct, labels, [-3, 0, 0], () => 1)).toContain("Scaphoid, proximal part");
    expect(labelAt(labels, [-2, 0, 0])).toBe(16);
  });
});

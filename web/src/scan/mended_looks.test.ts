// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { afterEach, describe, expect, it, vi } from "vitest";
import { MendedLooks } from "./mended_looks";
import type { MendedLook, MendWish } from "./new_case_client";
import { inverted, type Volume } from "./nifti_model";
import { LabelPaint } from "./paint_model";

const asked: MendWish[] = [];
vi.mock("./new_case_client", () => ({
  lookAtMended: (wish: MendWish): Promise<MendedLook> => {
    asked.push(wish);
    return Promise.resolve({ bones: [], labels: undefined, glb: undefined });
  },
}));

const HEAD = 352;
const rows = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
const labels = (): Volume => ({
  size: [4, 1, 1],
  patientFromVoxel: rows,
  voxelFromPatient: inverted(rows),
  values: Uint8Array.of(6, 6, 0, 5),
  head: new Uint8Array(HEAD),
});

async function valuesOf(packed: Blob | undefined): Promise<readonly number[]> {
  if (packed === undefined) return [];
  const stream = packed.stream().pipeThrough(new DecompressionStream("gzip"));
  return [...new Uint8Array(await new Response(stream).arrayBuffer()).slice(HEAD)];
}

describe("what is painted and looked at", () => {
  afterEach(() => {
    asked.length = 0;
  });
  const looksAt = (volume: Volume): { paint: LabelPaint; looks: MendedLooks } => {
    const paint = new LabelPaint(volume);
    const looks = new MendedLooks("demo", volume, paint, {
      say: () => undefined,
      show: () => undefined,
      labelsChanged: () => undefined,
    });
    return { paint, looks };
  };
  const mark = (paint: LabelPaint): void => {
    paint.begin();
    paint.stroke([1, 0, 0], [1, 0, 0], 0.2, 6);
    paint.end();
  };

  it("is looked at without the marker first, however soon the marker followed", async () => {
    const { paint, looks } = looksAt(labels());
    paint.merge(6, 0);
    looks.changed(false);
    mark(paint);
    looks.changed(true);
    await vi.waitFor(() => {
      expect(asked).toHaveLength(2);
    });
    const [first, second] = asked;
    expect([first?.grows, second?.grows]).toEqual([false, true]);
    expect(await valuesOf(first?.labels)).toEqual([0, 0, 0, 5]);
    expect(await valuesOf(second?.before)).toEqual([0, 0, 0, 5]);
    expect(await valuesOf(second?.labels)).toEqual([0, 6, 0, 5]);
  });
  it("is one look where the marker came alone, or was not used", async () => {
    const { paint, looks } = looksAt(labels());
    paint.merge(6, 0);
    looks.changed(false);
    await vi.waitFor(() => {
      expect(asked).toHaveLength(1);
    });
    mark(paint);
    looks.changed(true);
    await vi.waitFor(() => {
      expect(asked).toHaveLength(2);
    });
    await new Promise((wake) => setTimeout(wake, 300));
    expect(asked.map(({ grows }) => grows)).toEqual([false, true]);
  });
});

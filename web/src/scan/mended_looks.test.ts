// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { beforeEach, describe, expect, it, vi } from "vitest";
import { MendedLooks } from "./mended_looks";
import type { MendedLook, MendWish } from "./new_case_client";
import { inverted, type Volume } from "./nifti_model";
import { packedLabels } from "./packed_labels";
import { LabelPaint } from "./paint_model";

const asked: MendWish[] = [];
let answer: (wish: MendWish) => Promise<Blob | undefined>;
vi.mock("./new_case_client", () => ({
  lookAtMended: async (wish: MendWish): Promise<MendedLook> => {
    asked.push(wish);
    return { bones: [], labels: await answer(wish), glb: undefined };
  },
}));

const HEAD = 352;
const rows = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
/** Of four voxels side by side, as the host sends it too. */
function headOfFile(): Uint8Array {
  const head = new Uint8Array(HEAD);
  const view = new DataView(head.buffer);
  view.setInt32(0, 348, true);
  [3, 4, 1, 1].forEach((n, i) => {
    view.setInt16(40 + 2 * i, n, true);
  });
  view.setInt16(70, 2, true);
  view.setFloat32(108, HEAD, true);
  view.setInt16(254, 1, true);
  rows.forEach((value, i) => {
    view.setFloat32(280 + 4 * i, i < 8 ? -value : value, true);
  });
  view.setUint32(344, 0x6e2b3100);
  return head;
}
const labels = (): Volume => ({
  size: [4, 1, 1],
  patientFromVoxel: rows,
  voxelFromPatient: inverted(rows),
  values: Uint8Array.of(6, 6, 0, 5),
  head: headOfFile(),
});

async function valuesOf(packed: Blob | undefined): Promise<readonly number[]> {
  if (packed === undefined) return [];
  const stream = packed.stream().pipeThrough(new DecompressionStream("gzip"));
  return [...new Uint8Array(await new Response(stream).arrayBuffer()).slice(HEAD)];
}

describe("what is painted and looked at", () => {
  beforeEach(() => {
    asked.length = 0;
    answer = () => Promise.resolve(undefined);
  });
  const looksAt = (volume: Volume): { paint: LabelPaint; looks: MendedLooks } => {
    const paint = new LabelPaint(volume);
    const looks = new MendedLooks("demo", volume, paint, {
      say: (text) => {
        expect(text).not.toContain("from before");
      },
      show: () => undefined,
      labelsChanged: () => undefined,
    });
    return { paint, looks };
  };
  const mark = (paint: LabelPaint, x = 1): void => {
    paint.begin();
    paint.stroke([x, 0, 0], [x, 0, 0], 0.2, 6);
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
  it("is not grown by a border that comes after the marker was taken back", async () => {
    const volume = labels();
    const { paint, looks } = looksAt(volume);
    let send: (grown: Blob) => void = () => undefined;
    answer = (wish) =>
      wish.grows ? new Promise((done) => (send = done)) : Promise.resolve(undefined);
    mark(paint, 2);
    looks.changed(true);
    await vi.waitFor(() => {
      expect(asked.at(-1)?.grows).toBe(true);
    });
    paint.undo();
    looks.changed(false);
    send(await packedLabels({ ...volume, values: Uint8Array.of(6, 6, 6, 6) }));
    // The surfaces are again those of what is there.
    await vi.waitFor(() => {
      expect(asked.map(({ grows }) => grows)).toEqual([true, false]);
    });
    expect(await valuesOf(asked.at(-1)?.labels)).toEqual([6, 6, 0, 5]);
    expect([...volume.values]).toEqual([6, 6, 0, 5]);
  });
});

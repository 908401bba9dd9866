// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { changesToTake, parseMended } from "./mended_model";

test("bones are read strictly", () => {
  const bones = [{ name: "lunate", label: 4, volume_mm3: 1850.5 }];
  const text = JSON.stringify({ format: "carpus mended bones", bones });
  expect(parseMended(text)).toEqual([{ name: "lunate", label: 4, volumeMm3: 1850.5 }]);
  expect(() => parseMended('{"format": "carpus case", "bones": []}')).toThrow("no mended bones");
  expect(() =>
    parseMended('{"format": "carpus mended bones", "bones": [{"name": "lunate"}]}'),
  ).toThrow("without a name");
});

test("what was painted since is not painted over", () => {
  const sent = Uint8Array.of(0, 0, 4, 4, 9);
  const grown = Uint8Array.of(4, 4, 4, 0, 9);
  const now = Uint8Array.of(0, 9, 4, 4, 0);
  const { indices, labels } = changesToTake(sent, grown, now);
  expect([...indices]).toEqual([0, 3]);
  expect([...labels]).toEqual([4, 0]);
  expect(() => changesToTake(sent, grown, Uint8Array.of(1))).toThrow("another size");
});

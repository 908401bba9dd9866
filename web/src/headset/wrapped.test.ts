// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from "vitest";
import { wrapped } from "./wrapped";

const letters = (part: string): number => part.length;

it("breaks between words", () => {
  expect(wrapped("drive the wire slowly", 10, letters)).toEqual(["drive the", "wire", "slowly"]);
});

it("leaves a longer word whole, and nothing of nothing", () => {
  expect(wrapped("an immeasurably long one", 8, letters)).toEqual([
    "an",
    "immeasurably",
    "long one",
  ]);
  expect(wrapped("  ", 8, letters)).toEqual([]);
});

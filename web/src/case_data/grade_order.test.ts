// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { inOrder } from "./grade_order";

const order = (...ids: string[]): string[] =>
  inOrder(ids.map((id) => ({ id }))).map(({ id }) => id);

describe("grades as they are shown", () => {
  it("are classes by name, what is well first", () => {
    expect(order("0", "1A", "1D", "2C", "2A", "2E")).toEqual(["0", "1A", "1D", "2A", "2C", "2E"]);
  });

  it("are as the host has them otherwise", () => {
    expect(order("0", "I", "II", "IV")).toEqual(["0", "I", "II", "IV"]);
    expect(order("within", "flush", "proud")).toEqual(["within", "flush", "proud"]);
    expect(order()).toEqual([]);
  });
});

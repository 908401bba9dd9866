// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Sizes read the same all along.
import { describe, expect, it } from "vitest";
import { withTimesSigns } from "./times_sign_model";

describe("withTimesSigns", () => {
  it("has one sign in all of a size, and leaves words alone", () => {
    expect(withTimesSigns("CT of 321 x 217 x 173 voxels of 0.3 x 0.3 × 0.5 mm, x-ray")).toBe(
      "CT of 321 × 217 × 173 voxels of 0.3 × 0.3 × 0.5 mm, x-ray",
    );
    expect(withTimesSigns("2 x 2 x 2 x 2")).toBe("2 × 2 × 2 × 2");
  });
});

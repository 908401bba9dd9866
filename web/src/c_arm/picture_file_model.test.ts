// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Names that every file system takes.
import { describe, expect, it } from "vitest";
import { pictureFileName } from "./picture_file_model";

describe("pictureFileName", () => {
  it.each([
    ["demo wrist (simulated)", 3, "PA", "demo_wrist_simulated_shot_3_PA.png"],
    ["a/b\\..:c", 12, "+15° / −30°", "a_b_c_shot_12_+15_-30.png"],
    ["Łódź 7", 1, "45P", "Łódź_7_shot_1_45P.png"],
  ])("%s", (patient, shot, view, name) => {
    expect(pictureFileName(patient, shot, view)).toBe(name);
  });
});

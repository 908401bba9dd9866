// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { lesionUniforms, MOST_PAINTED, scuffed, setLesions, type Lesion } from "./scope_lesions";

const lesion = (look: Lesion["look"], joint: string): Lesion => ({
  look,
  joint,
  body: "radius",
  from_mm: [1, 2, 3],
  to_mm: [4, 5, 6],
  radius_mm: 0.5,
});

describe("what is wrong in a joint", () => {
  it("is painted in its own joint alone, and a loose body is no paint", () => {
    const uniforms = lesionUniforms();
    setLesions(
      uniforms,
      [lesion("tear", "midcarpal"), lesion("bare", "radiocarpal"), lesion("loose", "radiocarpal")],
      "radiocarpal",
    );
    expect(uniforms.lesionCount.value).toBe(1);
    expect(uniforms.lesionTo.value[0]?.w).toBe(6);
    expect(uniforms.lesionFrom.value[0]?.w).toBe(0.5);
    setLesions(uniforms, [], "radiocarpal");
    expect(uniforms.lesionCount.value).toBe(0);
  });

  it("has cartilage hang in fronds where a punch bit it", () => {
    const uniforms = lesionUniforms();
    const scuffs = scuffed([
      { joint: "midcarpal", at_mm: [7, 8, 9] },
      { joint: "radiocarpal", at_mm: [1, 2, 3] },
    ]);
    setLesions(uniforms, scuffs, "radiocarpal");
    expect(uniforms.lesionCount.value).toBe(1);
    expect(uniforms.lesionFrom.value[0]?.toArray().slice(0, 3)).toEqual([1, 2, 3]);
    expect(uniforms.lesionTo.value[0]?.w).toBe(5);
  });

  it("is painted as far as there is room", () => {
    const uniforms = lesionUniforms();
    setLesions(uniforms, Array<Lesion>(MOST_PAINTED + 5).fill(lesion("soft", "a")), "a");
    expect(uniforms.lesionCount.value).toBe(MOST_PAINTED);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { bonesNow, isThere, nameOfLabel, whyMissing } from "./bones_now_model";
import { KNOWN_BONES, type ScannedBone } from "./scan_case_model";

const found = (name: string, label: number): ScannedBone => ({
  name,
  label,
  confidence: 0.9,
  flagged: false,
  why: "",
});
const counts =
  (of: Readonly<Record<number, number>>) =>
  (label: number): number =>
    of[label] ?? 0;

describe("bones as they are now", () => {
  const bones = [found("scaphoid", 3), found("hamate", 10)];
  it("say why one is missing", () => {
    const now = bonesNow(bones, counts({ 3: 5 }));
    const why = (label: number): string =>
      now
        .filter((bone) => bone.label === label)
        .map(whyMissing)
        .join();
    expect(why(10)).toBe("has no voxels any more");
    expect(why(16)).toBe("is not there: the scaphoid is in one piece");
    expect(why(15)).toBe("was not found");
  });

  it("are all that are known, those too that were not found", () => {
    const now = bonesNow(bones, counts({ 3: 5, 10: 7 }));
    expect(now.map(({ label }) => label)).toEqual(KNOWN_BONES.map(([label]) => label));
    expect(now.filter(isThere).map(({ name }) => name)).toEqual(["scaphoid", "hamate"]);
    expect(now.find(({ label }) => label === 15)).toMatchObject({
      name: "metacarpal5",
      presence: "not found",
      confidence: undefined,
    });
    expect(now.find(({ label }) => label === 3)?.confidence).toBe(0.9);
  });
  it("come and go with their voxels", () => {
    const now = bonesNow(bones, counts({ 3: 5, 15: 1 }));
    const presence = (label: number): unknown => now.find((one) => one.label === label)?.presence;
    expect([presence(3), presence(10), presence(15)]).toEqual(["found", "gone", "later"]);
  });
  it("have the names that a new version gives them: a scaphoid that is parted is proximal", () => {
    expect(nameOfLabel(3, counts({ 3: 5 }))).toBe("scaphoid");
    const now = bonesNow(bones, counts({ 3: 5, 16: 2, 10: 7 }));
    expect(now.filter(isThere).map(({ name }) => name)).toEqual([
      "scaphoid_proximal",
      "hamate",
      "scaphoid_distal",
    ]);
  });
  it("of labels that nobody knows follow as the case calls them", () => {
    const now = bonesNow([...bones, found("sesamoid", 40)], counts({ 40: 2 }));
    expect(now.at(-1)).toMatchObject({ name: "sesamoid", presence: "found" });
  });
});

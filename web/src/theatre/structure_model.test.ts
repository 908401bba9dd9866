// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { carriedBy, isStructure, STRUCTURES_NOTE } from "./structure_model";

const EPL = {
  structure: "tendon",
  title: "extensor pollicis longus",
  forearm: "radius",
  generated: true,
};

describe("structures of the host's scene", () => {
  it("knows a structure by what the node says of itself", () => {
    expect(isStructure(EPL)).toBe(true);
    expect(isStructure({ ...EPL, structure: "nerve", forearm: "ulna" })).toBe(true);
  });

  it("takes no bone, and nothing that does not say it was generated, for one", () => {
    expect(isStructure(undefined)).toBe(false);
    expect(isStructure({})).toBe(false);
    expect(isStructure({ ...EPL, structure: "bone" })).toBe(false);
    expect(isStructure({ ...EPL, forearm: "hand" })).toBe(false);
    expect(isStructure({ ...EPL, generated: false })).toBe(false);
  });

  it("is carried by radius, ulna and, for the hand, the capitate", () => {
    expect(carriedBy("radius")).toBe("radius");
    expect(carriedBy("ulna")).toBe("ulna");
    expect(carriedBy("capitate")).toBe("hand");
    expect(carriedBy("scaphoid_proximal")).toBeUndefined();
  });

  it("is never shown without saying that no scan shows it", () => {
    expect(STRUCTURES_NOTE).toContain("not seen in the CT");
  });
});

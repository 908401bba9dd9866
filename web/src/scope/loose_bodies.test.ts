// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { LooseBodies } from "./loose_bodies";
import type { Lesion } from "./scope_lesions";

const lesion = (look: Lesion["look"]): Lesion => ({
  look,
  joint: "radiocarpal",
  body: "radius",
  from_mm: [1, 2, 3],
  to_mm: [1, 2, 3],
  radius_mm: 0.9,
});

describe("loose bodies", () => {
  const loose = new LooseBodies(new THREE.MeshBasicMaterial());
  loose.set([lesion("tear"), lesion("loose"), lesion("loose")]);
  const [first, second] = loose.group.children;

  it("lie where the host has them, each by its place among the lesions", () => {
    expect(loose.group.children.length).toBe(2);
    loose.lay("radiocarpal", [{ lesion: 2, hand: -1, at_mm: [7, 8, 9] }]);
    expect(first?.visible).toBe(false);
    expect(second?.visible).toBe(true);
    expect(second?.position.toArray()).toEqual([7, 8, 9]);
  });

  it("are gone once they are out, and not seen from the other joint", () => {
    loose.lay("midcarpal", [{ lesion: 1, hand: 1, at_mm: [0, 0, 0] }]);
    expect([first?.visible, second?.visible]).toEqual([false, false]);
    loose.lay("radiocarpal", []);
    expect([first?.visible, second?.visible]).toEqual([false, false]);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { middleOfBones } from "./middle_of";

function boneAt(name: string, x: number): THREE.Mesh {
  const bone = new THREE.Mesh(new THREE.BoxGeometry(2, 2, 2));
  bone.name = name;
  bone.position.set(x, 0, 0);
  return bone;
}

describe("middleOfBones", () => {
  const bones = [
    boneAt("scaphoid_proximal", 0),
    boneAt("scaphoid_distal", 4),
    boneAt("lunate", 90),
  ];

  it("is that of all that are named, where they are", () => {
    expect(middleOfBones(bones, ["scaphoid_proximal", "scaphoid_distal"])?.toArray()).toEqual([
      2, 0, 0,
    ]);
    expect(middleOfBones(bones, ["hamate"])).toBeUndefined();
  });

  it("does not go with what hangs on a bone", () => {
    const ghost = boneAt("ghost", 45);
    bones[0]?.add(ghost);
    expect(middleOfBones(bones, ["scaphoid_proximal"])?.toArray()).toEqual([0, 0, 0]);
  });
});

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A bone takes what belongs to it along: rays meet it and its holes where it is now, nothing is made anew.
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { BoneRays, makeHittable } from "./bone_rays";
import type { BoneMesh, CaseScene } from "./case_scene";
import { boneMaterial } from "./materials";
import { MovingBones } from "./moving_bones";
import { Structures } from "./structures";
import type { Track } from "../protocol";

function makeScene(): CaseScene {
  const root = new THREE.Group();
  const bones = ["lunate", "capitate"].map((name, i): BoneMesh => {
    const bone = new THREE.Mesh(
      new THREE.BoxGeometry(10, 10, 10).translate(30 * i, 0, 0),
      boneMaterial(),
    );
    bone.name = name;
    makeHittable(bone);
    return bone;
  });
  root.add(...bones);
  root.updateMatrixWorld(true);
  return {
    root,
    bones,
    skin: undefined,
    bitmaps: new Map(),
    structures: new Structures([], new Set()),
    jointWalls: new Map(),
  };
}

function bone(scene: CaseScene, index: number): BoneMesh {
  const found = scene.bones[index];
  if (found === undefined) throw new Error("no such bone");
  return found;
}

function hitFrom(scene: CaseScene, x: number): number[] | undefined {
  const caster = new THREE.Raycaster(new THREE.Vector3(x, 1, 50), new THREE.Vector3(0, 0, -1));
  const out = new THREE.Vector3();
  return new BoneRays(scene.bones).first(caster, out) ? out.toArray() : undefined;
}

const hole: Track = {
  body: "capitate",
  from_mm: [30, 0, 5],
  to_mm: [30, 0, -2],
  from_radius_mm: 1,
  to_radius_mm: 1,
};

describe("setPose", () => {
  it("moves the bone and what rays meet, without another tree", () => {
    const scene = makeScene();
    const bones = new MovingBones(scene);
    const tree = bone(scene, 1).geometry.boundsTree;
    expect(bones.setPose("capitate", [0, 0, 0, 1], [0, 40, 0])).toBe(true);
    expect(hitFrom(scene, 30)).toBeUndefined();
    expect(bones.setPose("capitate", [0, 0, 0, 1], [20, 0, 3])).toBe(true);
    expect(hitFrom(scene, 50)).toEqual([50, 1, 8]);
    expect(hitFrom(scene, 0)).toEqual([0, 1, 5]);
    expect(bone(scene, 1).geometry.boundsTree).toBe(tree);
  });

  it("turns about Patient's origin", () => {
    const scene = makeScene();
    new MovingBones(scene).setPose("capitate", [0, 0, Math.SQRT1_2, Math.SQRT1_2], [0, 0, 0]);
    const middle = new THREE.Vector3(30, 0, 0).applyMatrix4(bone(scene, 1).matrixWorld);
    expect(middle.distanceTo(new THREE.Vector3(0, 30, 0))).toBeLessThan(1e-9);
  });

  it("says that nothing has moved where nothing has, or no bone is so named", () => {
    const bones = new MovingBones(makeScene());
    expect(bones.setPose("lunate", [0, 0, 0, 1], [0, 0, 0])).toBe(false);
    expect(bones.setPose("patella", [0, 0, 0, 1], [1, 0, 0])).toBe(false);
  });
});

describe("setTracks", () => {
  it("puts the hole's wall into the bone that was drilled, where it moves along", () => {
    const scene = makeScene();
    const bones = new MovingBones(scene);
    expect(bones.setTracks([hole])).toBe(true);
    expect(bone(scene, 0).children.length).toBe(0);
    const wall = bone(scene, 1).children[0] as THREE.Mesh;
    const box = new THREE.Box3().setFromObject(wall);
    expect(box.max.z).toBeCloseTo(5, 5);
    expect(box.min.z).toBeCloseTo(-2, 5);
    bones.setPose("capitate", [0, 0, 0, 1], [0, 0, 100]);
    expect(new THREE.Box3().setFromObject(wall).max.z).toBeCloseTo(105, 4);
  });

  it("keeps the walls of tracks that stay and makes only that of the one that goes on", () => {
    const scene = makeScene();
    const bones = new MovingBones(scene);
    const other: Track = { ...hole, from_mm: [27, 0, 5], to_mm: [27, 0, 0] };
    bones.setTracks([other, hole]);
    const before = [...bone(scene, 1).children];
    expect(bones.setTracks([other, hole])).toBe(false);
    expect(bones.setTracks([other, { ...hole, to_mm: [30, 0, -3] }])).toBe(true);
    const after = bone(scene, 1).children;
    expect(after.length).toBe(2);
    expect(after.filter((wall) => before.includes(wall)).length).toBe(1);
  });

  it("takes holes away again, and shows none of a track that is none", () => {
    const scene = makeScene();
    const bones = new MovingBones(scene);
    bones.setTracks([hole]);
    expect(bones.setTracks([])).toBe(true);
    expect(bone(scene, 1).children.length).toBe(0);
    expect(bones.setTracks([{ ...hole, to_mm: [NaN, 0, 0] }])).toBe(false);
  });
});

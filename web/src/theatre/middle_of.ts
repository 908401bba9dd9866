// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Middle of bones where they are now. Of their surfaces alone: what hangs on a bone (the ghost of the
// ideal, walls of holes) reaches far beyond it.
import * as THREE from "three";

const box = new THREE.Box3();
const one = new THREE.Box3();

/** @return nothing where no bone has one of these names [m] */
export function middleOfBones(
  bones: readonly THREE.Mesh[],
  names: readonly string[],
): THREE.Vector3 | undefined {
  box.makeEmpty();
  for (const bone of bones) {
    if (!names.includes(bone.name)) continue;
    if (bone.geometry.boundingBox === null) bone.geometry.computeBoundingBox();
    if (bone.geometry.boundingBox === null) continue;
    bone.updateWorldMatrix(true, false);
    box.union(one.copy(bone.geometry.boundingBox).applyMatrix4(bone.matrixWorld));
  }
  return box.isEmpty() ? undefined : box.getCenter(new THREE.Vector3());
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bones where they are now, and what was drilled out of each. A bone takes its name's leader, its
// tree for rays and its tunnels along; the skin follows.
import type { Vec3 } from "../protocol";
import type { BoneMesh, CaseScene } from "./case_scene";
import { DrilledBone } from "./drilled_bone";
import type { Rotation } from "./skin_blend_model";
import type { Track } from "../protocol";

export class MovingBones {
  private readonly byName: ReadonlyMap<string, BoneMesh>;
  private readonly drilled = new Map<string, DrilledBone>();

  constructor(private readonly scene: CaseScene) {
    this.byName = new Map(scene.bones.map((bone) => [bone.name, bone]));
  }

  /**
   * Puts a bone where it is now; a bone that is not there is passed over.
   * @param rotation  x, y, z, w; with the translation [mm] Patient from where it was in the case
   * @return whether it has moved
   */
  setPose(name: string, rotation: Rotation, translationMm: Vec3): boolean {
    const bone = this.byName.get(name);
    if (bone === undefined) return false;
    const [x, y, z, w] = rotation;
    const [tx, ty, tz] = translationMm;
    const { position: p, quaternion: q } = bone;
    if (q.x === x && q.y === y && q.z === z && q.w === w && p.x === tx && p.y === ty && p.z === tz)
      return false;
    q.set(x, y, z, w);
    p.set(tx, ty, tz);
    // Rays come between two pictures too.
    bone.updateWorldMatrix(true, true);
    this.scene.skin?.follow(name, { rotation, translationMm });
    this.scene.structures.follow(name, { rotation, translationMm });
    return true;
  }

  /** @return whether anything looks different now */
  setTracks(tracks: readonly Track[]): boolean {
    let changed = false;
    for (const [name, bone] of this.byName) {
      const own = tracks.filter((track) => track.body === name);
      let drilled = this.drilled.get(name);
      if (drilled === undefined) {
        if (own.length === 0) continue;
        drilled = new DrilledBone(bone);
        this.drilled.set(name, drilled);
      }
      if (drilled.setTracks(own)) changed = true;
    }
    return changed;
  }

  dispose(): void {
    for (const drilled of this.drilled.values()) drilled.dispose();
  }
}

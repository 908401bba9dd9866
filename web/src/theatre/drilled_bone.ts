// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Shows what was drilled out of a bone: its surface is left out within the tracks (track_shader.ts), and
// the tunnel's wall is real surface, clipped to the bone once per track (tunnel_model.ts). So holes look
// the same from all sides, in bone that is cut open or seen through, and need neither stencil nor order.
import * as THREE from "three";
import type { Track } from "../protocol";
import { stretchesWithin } from "./bone_rays";
import { tunnelMaterial, withTracks } from "./materials";
import { makeTrackUniforms, setTrackUniforms } from "./track_shader";
import { isTrack, MAX_TRACKS, tunnelWall } from "./tunnel_model";

interface ShownTrack {
  readonly key: string;
  readonly wall: THREE.Mesh;
}

function keyOf(track: Track): string {
  const { from_mm, to_mm, from_radius_mm, to_radius_mm } = track;
  return [...from_mm, ...to_mm, from_radius_mm, to_radius_mm].join(" ");
}

export class DrilledBone {
  private readonly uniforms = makeTrackUniforms();
  private readonly wallMaterial: THREE.Material;
  private shown: ShownTrack[] = [];

  /** @param bone  hittable (bone_rays.ts); its material from now on is the bone's own */
  constructor(private readonly bone: THREE.Mesh<THREE.BufferGeometry, THREE.Material>) {
    withTracks(bone.material, this.uniforms);
    this.wallMaterial = tunnelMaterial(this.uniforms);
  }

  /** @return whether anything looks different now */
  setTracks(tracks: readonly Track[]): boolean {
    const good = tracks.filter(isTrack).slice(0, MAX_TRACKS);
    const keys = good.map(keyOf);
    if (keys.length === this.shown.length && keys.every((key, i) => key === this.shown[i]?.key))
      return false;
    const before = new Map(this.shown.map((shown) => [shown.key, shown]));
    this.shown = good.map((track, i) => {
      const key = keys[i] ?? "";
      const kept = before.get(key);
      before.delete(key);
      return kept ?? { key, wall: this.makeWall(track) };
    });
    for (const { wall } of before.values()) this.remove(wall);
    setTrackUniforms(this.uniforms, good);
    return true;
  }

  dispose(): void {
    for (const { wall } of this.shown) this.remove(wall);
    this.shown = [];
    this.wallMaterial.dispose();
  }

  private makeWall(track: Track): THREE.Mesh {
    const wall = tunnelWall(track, (origin, direction, lengthMm) =>
      stretchesWithin(this.bone.geometry, origin, direction, lengthMm),
    );
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(wall.positions, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(wall.normals, 3));
    geometry.setAttribute("depths", new THREE.BufferAttribute(wall.depths, 2));
    geometry.setIndex(new THREE.BufferAttribute(wall.index, 1));
    const mesh = new THREE.Mesh(geometry, this.wallMaterial);
    // In the bone's own frame: where the bone goes the hole goes.
    this.bone.add(mesh);
    return mesh;
  }

  private remove(wall: THREE.Mesh): void {
    this.bone.remove(wall);
    wall.geometry.dispose();
  }
}

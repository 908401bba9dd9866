// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// In the fragment shader of a bone: which of its surface was drilled away. The same distance as
// outsideTrack() in tunnel_model.ts.
import * as THREE from "three";
import type { Track } from "../protocol";
import { MAX_TRACKS, MOUTH_RADII } from "./tunnel_model";

/** Shared by the bone's materials: set once, seen by all. */
export interface TrackUniforms {
  readonly trackCount: { value: number };
  /** Start and its radius, end and its radius [mm]. */
  readonly trackStart: { readonly value: THREE.Vector4[] };
  readonly trackEnd: { readonly value: THREE.Vector4[] };
}

export function makeTrackUniforms(): TrackUniforms {
  const none = (): THREE.Vector4[] =>
    Array.from({ length: MAX_TRACKS }, () => new THREE.Vector4(0, 0, 0, 0));
  return { trackCount: { value: 0 }, trackStart: { value: none() }, trackEnd: { value: none() } };
}

export function setTrackUniforms(uniforms: TrackUniforms, tracks: readonly Track[]): void {
  uniforms.trackCount.value = Math.min(MAX_TRACKS, tracks.length);
  tracks.slice(0, MAX_TRACKS).forEach((track, i) => {
    uniforms.trackStart.value[i]?.set(...track.from_mm, track.from_radius_mm);
    uniforms.trackEnd.value[i]?.set(...track.to_mm, track.to_radius_mm);
  });
}

/** `outsideTracks(p)`: distance of a point of the bone [mm] from the nearest track, negative within. */
export const TRACKS_GLSL = /* glsl */ `
uniform int trackCount;
uniform vec4 trackStart[${MAX_TRACKS}];
uniform vec4 trackEnd[${MAX_TRACKS}];
float outsideTracks(vec3 p) {
  float nearest = 1.0e3;
  for (int i = 0; i < ${MAX_TRACKS}; ++i) {
    if (i >= trackCount) break;
    vec3 axis = trackEnd[i].xyz - trackStart[i].xyz;
    float size = length(axis);
    axis /= size;
    vec3 q = p - trackStart[i].xyz;
    float s = dot(q, axis);
    float radial = length(q - s * axis);
    float r = mix(trackStart[i].w, trackEnd[i].w, s / size);
    float away = max(radial - r, max(-${MOUTH_RADII.toFixed(1)} * trackStart[i].w - s, s - size));
    nearest = min(nearest, away);
  }
  return nearest;
}
`;

/**
 * At the beginning of a bone's fragment: leaves out what was drilled away. `boneEdge` is 0 at the rim
 * and 1 a pixel beside it, so that the rim is smooth where nothing else softens it.
 */
export const CUT_GLSL = /* glsl */ `
float boneAway = 1.0e3;
if (trackCount > 0) boneAway = outsideTracks(vBoneMm);
float bonePixel = max(fwidth(boneAway), 1.0e-4);
if (boneAway < -0.5 * bonePixel) discard;
float boneEdge = clamp(boneAway / bonePixel + 0.5, 0.0, 1.0);
`;

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the C-arm's beam runs in the room: the renderer's axes (frames/), in which the room stands. As
// src/fluoroscopy/c_arm.cpp turns it: about the forearm as scanned, from dorsal towards radial, then along it.
import type { Vec3 } from "../protocol";

/** Of the host's C-arm (src/fluoroscopy/c_arm.hpp) [m]. */
export const SOURCE_TO_TARGET_M = 0.36;
export const TARGET_TO_RECEPTOR_M = 0.09;
export const FIELD_RADIUS_M = 0.04;

export interface RoomAngles {
  /** About the forearm as scanned: 0 from dorsal, 90 from radial [deg]. */
  readonly rotationDeg: number;
  /** Source towards proximal (positive) or distal [deg]. */
  readonly tiltDeg: number;
}

/** The forearm turns under the C-arm: what is told is counted from the forearm as it is held. */
export function roomAngles(
  stand: { readonly rotation_deg: number; readonly tilt_deg: number },
  pronationDeg: number,
): RoomAngles {
  return { rotationDeg: stand.rotation_deg + pronationDeg, tiltDeg: stand.tilt_deg };
}

/**
 * Unit vector from what is looked at to the source.
 * @param radialIsRight  thumb to the right, as a left hand's from dorsal
 */
export function towardsSource({ rotationDeg, tiltDeg }: RoomAngles, radialIsRight: boolean): Vec3 {
  const rotation = (rotationDeg * Math.PI) / 180;
  const tilt = (tiltDeg * Math.PI) / 180;
  const radial = radialIsRight ? 1 : -1;
  return [
    radial * Math.sin(rotation) * Math.cos(tilt),
    -Math.sin(tilt),
    Math.cos(rotation) * Math.cos(tilt),
  ];
}

/** So long it is shown after the C-arm was moved [ms]. */
const SHOWN_MS = 2500;
/** A turn that counts as one [deg]. */
const MOVED_DEG = 0.5;

/** When the beam is drawn: while the C-arm moves and a moment longer, or for as long as it is wished. */
export class BeamShown {
  private last: RoomAngles | undefined;
  private movedAtMs = -Infinity;
  isWished = false;

  /** @return whether it is drawn now */
  update(angles: RoomAngles, nowMs: number): boolean {
    const { last } = this;
    const moved =
      last !== undefined &&
      (Math.abs(last.rotationDeg - angles.rotationDeg) > MOVED_DEG ||
        Math.abs(last.tiltDeg - angles.tiltDeg) > MOVED_DEG);
    if (last === undefined || moved) this.last = angles;
    if (moved) this.movedAtMs = nowMs;
    return this.isWished || nowMs - this.movedAtMs < SHOWN_MS;
  }

  /** Another exercise: where its C-arm stands is no move. */
  forget(): void {
    this.last = undefined;
    this.movedAtMs = -Infinity;
  }
}

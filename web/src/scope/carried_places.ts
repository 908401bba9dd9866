// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Places of soft tissue that go with up to four bones each, as far with each as the host says (arthroscopy/carried.hpp).
import type { BodyPose } from "../protocol";

/** Bodies a place. */
const MOST = 4;
/** Numbers of a motion: three rows of a turn, each with its shift. */
const ROWS = 12;

export class CarriedPlaces {
  private readonly bodies: Uint8Array;
  private readonly shares: Float32Array;
  private motions = new Float32Array(0);

  /** @param bodies  four a place, by their places in the case's order @param shares  of each, 1 in all, the foremost first */
  constructor(bodies: ArrayLike<number>, shares: ArrayLike<number>) {
    this.bodies = Uint8Array.from(bodies);
    this.shares = Float32Array.from(shares);
  }

  /** Where the bodies have them. @param into, rest  three a place */
  lay(into: Float32Array, rest: Float32Array, poses: readonly BodyPose[]): void {
    if (this.motions.length !== ROWS * poses.length)
      this.motions = new Float32Array(ROWS * poses.length);
    const { bodies, shares, motions: m } = this;
    poses.forEach((pose, body) => {
      writeMotion(m, ROWS * body, pose);
    });
    for (let v = 0; 3 * v < rest.length; ++v) {
      const [x, y, z] = [rest[3 * v] ?? 0, rest[3 * v + 1] ?? 0, rest[3 * v + 2] ?? 0];
      let [px, py, pz] = [0, 0, 0];
      for (let k = MOST * v; k < MOST * v + MOST; ++k) {
        const share = shares[k] ?? 0;
        if (share === 0) break;
        const i = ROWS * (bodies[k] ?? 0);
        px +=
          share * ((m[i] ?? 0) * x + (m[i + 1] ?? 0) * y + (m[i + 2] ?? 0) * z + (m[i + 3] ?? 0));
        py +=
          share *
          ((m[i + 4] ?? 0) * x + (m[i + 5] ?? 0) * y + (m[i + 6] ?? 0) * z + (m[i + 7] ?? 0));
        pz +=
          share *
          ((m[i + 8] ?? 0) * x + (m[i + 9] ?? 0) * y + (m[i + 10] ?? 0) * z + (m[i + 11] ?? 0));
      }
      into[3 * v] = px;
      into[3 * v + 1] = py;
      into[3 * v + 2] = pz;
    }
  }
}

function writeMotion(into: Float32Array, at: number, pose: BodyPose): void {
  const [w, x, y, z] = pose.quaternion;
  const [tx, ty, tz] = pose.translation_mm;
  into.set(
    [
      1 - 2 * (y * y + z * z),
      2 * (x * y - w * z),
      2 * (x * z + w * y),
      tx,
      2 * (x * y + w * z),
      1 - 2 * (x * x + z * z),
      2 * (y * z - w * x),
      ty,
      2 * (x * z - w * y),
      2 * (y * z + w * x),
      1 - 2 * (x * x + y * y),
      tz,
    ],
    at,
  );
}

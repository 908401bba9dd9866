// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where to look at a bone: a place of its own near its middle. The middle itself may lie in a hollow.
import type { Vec3 } from "../protocol";
import { applied, type Volume } from "./nifti_model";

/** @return undefined where no voxel has the label */
export function placeOfLabel(labels: Volume, label: number): Vec3 | undefined {
  const [w, h, d] = labels.size;
  const { values } = labels;
  let count = 0;
  let [sx, sy, sz] = [0, 0, 0];
  for (let z = 0, i = 0; z < d; ++z) {
    for (let y = 0; y < h; ++y) {
      for (let x = 0; x < w; ++x, ++i) {
        if (values[i] !== label) continue;
        ++count;
        sx += x;
        sy += y;
        sz += z;
      }
    }
  }
  if (count === 0) return undefined;
  const middle: Vec3 = [sx / count, sy / count, sz / count];
  let best = Infinity;
  let place: Vec3 = middle;
  for (let z = 0, i = 0; z < d; ++z) {
    for (let y = 0; y < h; ++y) {
      for (let x = 0; x < w; ++x, ++i) {
        if (values[i] !== label) continue;
        const far = (x - middle[0]) ** 2 + (y - middle[1]) ** 2 + (z - middle[2]) ** 2;
        if (far >= best) continue;
        best = far;
        place = [x, y, z];
      }
    }
  }
  return applied(labels.patientFromVoxel, place);
}

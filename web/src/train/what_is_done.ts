// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What there is to see of what a person does, for the first touch.
import type { Observation } from "../first_touch";
import { heldItem } from "../operation";
import type { ScopeMessage, SnapshotMessage } from "../protocol";
import type { Theatre } from "../theatre";
import type { Hand } from "./hand";

export function whatIsDone(
  s: SnapshotMessage,
  scope: ScopeMessage | undefined,
  hand: Hand,
  theatre: Theatre,
): Observation {
  const item = heldItem(s, hand.active);
  const isIn = scope?.in_joint[scope.hand] === 1;
  const held = isIn ? heldItem(s, scope.hand === 0 ? 0 : 1) : undefined;
  const axes = theatre.screenAxes();
  return {
    screenRight: axes.right,
    screenUp: axes.up,
    free: item?.body === "" ? { tip: item.tip_mm, shaft: item.shaft } : undefined,
    depthMm: item !== undefined && item.body !== "" ? item.depth_mm : 0,
    shots: s.shots,
    undos: s.undos,
    hand: hand.active,
    inJoint: isIn,
    scope:
      scope === undefined || held === undefined
        ? undefined
        : {
            tip: held.tip_mm,
            shaft: held.shaft,
            shaftDeg: scope.shaft_deg,
            cameraDeg: scope.camera_deg,
          },
  };
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What there is to see of what a person does, for the first touch.
import type { Observation } from "../first_touch";
import { heldItem } from "../operation";
import type { SnapshotMessage } from "../protocol";
import type { Theatre } from "../theatre";
import type { Hand } from "./hand";

export function whatIsDone(s: SnapshotMessage, hand: Hand, theatre: Theatre): Observation {
  const item = heldItem(s, hand.active);
  const axes = theatre.screenAxes();
  return {
    screenRight: axes.right,
    screenUp: axes.up,
    free: item?.body === "" ? { tip: item.tip_mm, shaft: item.shaft } : undefined,
    depthMm: item !== undefined && item.body !== "" ? item.depth_mm : 0,
    shots: s.shots,
    undos: s.undos,
  };
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a snapshot sounds like, with what the hand does now.
import { heldItem } from "../operation";
import type { ExerciseMessage, SnapshotMessage } from "../protocol";
import type { ForceGrade } from "../scope";
import type { Heard } from "../sound";
import type { Hand } from "./hand";

const PRESSES: Readonly<Record<ForceGrade, Heard["press"]>> = {
  good: "none",
  warning: "hard",
  injury: "harm",
};

/** @param press  of what lies in a joint */
export function whatIsHeard(
  s: SnapshotMessage,
  exercise: ExerciseMessage | undefined,
  hand: Hand,
  press: ForceGrade,
  nowMs: number,
): Heard {
  const item = heldItem(s, hand.active);
  const kind = exercise?.instruments.find((one) => one.id === item?.instrument);
  return {
    nowMs,
    driver: s.paused || s.finished ? "off" : hand.driver,
    drive: kind?.drive ?? "none",
    resistanceN: s.hands[hand.active].resistance_n,
    torqueNMm: s.hands[hand.active].torque_n_mm,
    depthMm: item?.depth_mm ?? 0,
    pitchMm: kind?.parts.find((part) => part.is_threaded)?.pitch_mm ?? 0,
    live: s.c_arm.live,
    shots: s.shots,
    press: s.paused || s.finished ? "none" : PRESSES[press],
  };
}

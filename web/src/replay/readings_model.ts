// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the bars of the room told then, in a line.
import type { ExerciseMessage, SnapshotMessage } from "../protocol";

export function readingsOf(s: SnapshotMessage, exercise: ExerciseMessage): string {
  const parts: string[] = [];
  const step = exercise.steps[s.step];
  if (step !== undefined)
    parts.push(`step ${s.step + 1} of ${exercise.steps.length}: ${step.title}`);
  else parts.push("finished");
  for (const item of s.items) {
    const instrument = exercise.instruments.find((one) => one.id === item.instrument);
    if (instrument === undefined || (item.hand < 0 && item.body === "")) continue;
    const depth = item.body === "" ? "" : ` ${item.depth_mm.toFixed(1)} mm deep`;
    parts.push(`${instrument.name}${depth}`);
  }
  const push = Math.max(...s.hands.map((hand) => Math.hypot(...hand.force_n)));
  if (push >= 0.5) parts.push(`force ${push.toFixed(0)} N`);
  const shots = s.shots === 1 ? "1 shot" : `${s.shots} shots`;
  parts.push(`${shots}, ${s.dose_cgy_cm2.toFixed(1)} cGy cm²`);
  if (s.undos > 0) parts.push(`undone ${s.undos}×`);
  return parts.join(" · ");
}

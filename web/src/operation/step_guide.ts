// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps in words: a name for the list, one sentence with its key or gesture for the current one.
// Clinical sources: docs/scoring.md.
import type { SnapshotMessage } from "../protocol";

export type StepId = SnapshotMessage["step"];

export interface StepText {
  readonly id: StepId;
  readonly name: string;
  /** What to do now. */
  readonly sentence: string;
  readonly keys: string;
}

/** In the order of the host's bits. */
export const STEPS: readonly StepText[] = [
  {
    id: "survey",
    name: "Survey",
    sentence: "Look at the fracture in at least two views.",
    keys: "1 PA, 2 lateral",
  },
  {
    id: "entry",
    name: "Entry point",
    sentence:
      "Place the wire's tip on the proximal pole of the scaphoid, beside the scapholunate ligament.",
    keys: "Left drag, then arrows (0.1 mm)",
  },
  {
    id: "aim",
    name: "Aim",
    sentence: "Turn the shaft onto the central axis, towards the base of the thumb.",
    keys: "Shift + drag, then Shift + arrows (0.5°)",
  },
  {
    id: "drive",
    name: "Drive the wire",
    sentence: "Drive until the tip lies just under the distal cortex; check it on pictures.",
    keys: "Hold Space; R reverses",
  },
  {
    id: "check",
    name: "Check the views",
    sentence: "Look for a tip that came out: 45° pronated shows what PA and lateral miss.",
    keys: "3 is 45P; 1, 2, 6",
  },
  {
    id: "measure",
    name: "Measure",
    sentence: "Read the depth gauge along the wire.",
    keys: "M",
  },
  {
    id: "choose",
    name: "Choose a screw",
    sentence: "Choose the longest screw that is at least 4 mm shorter than measured.",
    keys: "C, arrows, Enter",
  },
  {
    id: "insert",
    name: "Insert the screw",
    sentence:
      "Drive the screw over the wire until its tail is buried 2 mm. Once it is seated, letting go takes driver and wire out.",
    keys: "Hold Space; R brings it back",
  },
  {
    id: "verify",
    name: "Final views",
    sentence:
      "Look at the screw, now alone, from PA, lateral, 45° pronated and the skyline, then finish. Space takes the driver again.",
    keys: "1, 2, 3, 6, then F",
  },
  { id: "finished", name: "Score", sentence: "The operation is finished.", keys: "" },
];

export function stepText(id: StepId): StepText {
  const found = STEPS.find((step) => step.id === id);
  if (found === undefined) throw new Error(`unknown step '${id}'`);
  return found;
}

/** Whether bit i of `completed_steps` is set. */
export function isCompleted(completedSteps: number, step: StepText): boolean {
  return (completedSteps & (1 << STEPS.indexOf(step))) !== 0;
}

/** Said while the driver runs and nothing moves. */
export function whyStuck(snapshot: SnapshotMessage, thrustN: number): string | undefined {
  const bone = Math.round(snapshot.resistance_n);
  if (snapshot.wire_engaged && snapshot.resistance_n > 0 && snapshot.resistance_n >= thrustN) {
    return `The bone resists ${bone} N, you push ${thrustN} N: push more with ].`;
  }
  if (!snapshot.wire_engaged && snapshot.instrument === "guide_wire" && !snapshot.touching) {
    return "The tip touches no bone: A brings it nearer, or drag it onto the bone.";
  }
  return undefined;
}

/** What gives the best hint when a key cannot do anything now, in words. */
export function whyNot(action: string, snapshot: SnapshotMessage): string | undefined {
  switch (action) {
    case "move_tip":
    case "turn_shaft":
    case "approach":
      if (snapshot.instrument === "none") {
        return "Driver and wire are out, the screw is seated. Space drives it deeper, R brings it back.";
      }
      if (snapshot.instrument === "screw_driver") {
        return "The screw runs on the wire. Hold Space to drive it, R to bring it back.";
      }
      return snapshot.wire_engaged
        ? "The wire is held by the bone. Hold R to bring it out, then place it anew."
        : undefined;
    case "measure":
      return snapshot.wire_engaged
        ? undefined
        : "Nothing to measure yet: drive the wire into the scaphoid first (Space).";
    case "screws":
      return snapshot.wire_engaged
        ? undefined
        : "A screw runs on the wire: drive the wire into the scaphoid first (Space).";
    default:
      return undefined;
  }
}

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What hands must know before they look into a joint: a shaft goes in and leans about its hole, turning it looks
// elsewhere without moving, and the horizon is the camera head's.
import { degreesBetween, type Lesson } from "./first_touch_model";

const LEAN_DEG = 4;
const TURN_DEG = 20;
const LEVEL_DEG = 8;

const turned = (from: number, to: number): number => {
  const by = Math.abs(to - from) % 360;
  return Math.min(by, 360 - by);
};

export const SCOPE_LESSON: Lesson = {
  id: "carpus.first_touch.scope",
  spoils: false,
  tasks: [
    {
      id: "go_in",
      name: "Go in by the portal",
      mouse: "Pull the joint open first; then turn the wheel over the picture.",
      finger: "Pull the joint open first; then spread two fingers on one half of the picture.",
      keys: "hold {KeyW}, then {KeyA}",
      gamepad:
        "Up on the cross pulls the joint open; then RB, with the hand that mouse and keys do not lead.",
      isDone: (first, now) => now.inJoint && !first.inJoint,
    },
    {
      id: "lean",
      name: "Lean",
      mouse: "Drag with the left button: the shaft leans about its hole.",
      finger: "Drag with one finger: the shaft leans about its hole.",
      keys: "Arrows",
      gamepad: "The left stick.",
      isDone: ({ scope: a }, { scope: b }) =>
        a !== undefined && b !== undefined && degreesBetween(a.shaft, b.shaft) > LEAN_DEG,
    },
    {
      id: "look_round",
      name: "Look round",
      mouse: "Drag with the right button: the shaft turns, and an angled lens looks elsewhere.",
      finger: "Hold Shaft ↺ or ↻ below: an angled lens looks elsewhere.",
      keys: "{Comma} {Period}",
      gamepad: "The right stick, sideways.",
      isDone: ({ scope: a }, { scope: b }) =>
        a !== undefined && b !== undefined && turned(a.shaftDeg, b.shaftDeg) > TURN_DEG,
    },
    {
      id: "level",
      name: "Keep the horizon",
      mouse: "Hold Camera ↺ or ↻ below until up is up again; Level does it in practice.",
      finger: "Hold Camera ↺ or ↻ below until up is up again; Level does it in practice.",
      keys: "Shift + {Comma} {Period}, 8",
      gamepad: "The right stick, up and down.",
      isDone: ({ scope: a }, { scope: b }) =>
        a !== undefined && b !== undefined && turned(a.cameraDeg, b.cameraDeg) > LEVEL_DEG,
    },
    {
      id: "other_hand",
      name: "The other hand",
      mouse: "Other hand below: mouse and keys lead it then.",
      finger: "Other hand below, or a finger on the other half of the picture.",
      keys: "{KeyH}",
      gamepad: "The left stick pressed exchanges the hands.",
      isDone: (first, now) => now.hand !== first.hand,
    },
  ],
};

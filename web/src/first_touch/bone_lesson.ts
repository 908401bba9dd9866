// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What hands must know before a wire goes into a bone.
import { degreesBetween, type Lesson } from "./first_touch_model";

const LOOK_DEG = 10;
const MOVE_MM = 3;
const AIM_DEG = 5;
const DRIVE_MM = 1;

export const BONE_LESSON: Lesson = {
  id: "carpus.first_touch",
  spoils: true,
  tasks: [
    {
      id: "look",
      name: "Turn the view",
      mouse: "Drag with the right button.",
      finger: "Drag with two fingers.",
      keys: "Ctrl + arrows",
      gamepad: "The cross turns it; the right stick pressed goes to the next view.",
      isDone: (first, now) =>
        degreesBetween(first.screenRight, now.screenRight) > LOOK_DEG ||
        degreesBetween(first.screenUp, now.screenUp) > LOOK_DEG,
    },
    {
      id: "move",
      name: "Move the tip",
      mouse: "Drag it onto a bone with the left button.",
      finger: "Drag with one finger: it pushes the tip along.",
      keys: "Arrows, {KeyA} {KeyD}",
      gamepad: "The left stick; RB brings it nearer, LB back.",
      isDone: ({ free: a }, { free: b }) =>
        a !== undefined &&
        b !== undefined &&
        Math.hypot(a.tip[0] - b.tip[0], a.tip[1] - b.tip[1], a.tip[2] - b.tip[2]) > MOVE_MM,
    },
    {
      id: "aim",
      name: "Aim",
      mouse: "Shift + drag turns the shaft, or look along the way and press Enter.",
      finger: "Choose Shaft below and drag, or look along the way and touch Aim.",
      keys: "Shift + arrows, Enter",
      gamepad: "The right stick, or look along the way and press B.",
      isDone: ({ free: a }, { free: b }) =>
        a !== undefined && b !== undefined && degreesBetween(a.shaft, b.shaft) > AIM_DEG,
    },
    {
      id: "drive",
      name: "Push and drive",
      mouse: "With the tip on bone hold Drive. Less push where bone is soft.",
      finger: "With the tip on bone hold Drive. Less push where bone is soft.",
      keys: "hold Space, {BracketLeft} {BracketRight}",
      gamepad: "With the tip on bone: the right trigger, as deep as you push.",
      isDone: (_, now) => now.depthMm > DRIVE_MM,
    },
    {
      id: "shot",
      name: "Take a picture",
      mouse: "Choose a view of the C-arm.",
      finger: "Touch a view of the C-arm.",
      keys: "1 … 6, hold {KeyE}",
      gamepad: "A; Y takes the next view, X held looks live.",
      isDone: (first, now) => now.shots > first.shots,
    },
    {
      id: "undo",
      name: "Undo",
      mouse: "Back to before the bone was entered.",
      finger: "Back to before the bone was entered.",
      keys: "{KeyZ}",
      gamepad: "Back.",
      isDone: (first, now) => now.undos > first.undos,
    },
  ],
};

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which lesson an operation begins with. Making portals has words of its own for each thing, and none.
import type { ExerciseMessage } from "../protocol";
import { BONE_LESSON } from "./bone_lesson";
import type { Lesson } from "./first_touch_model";
import { SCOPE_LESSON } from "./scope_lesson";

export function lessonOf(
  exercise: Pick<ExerciseMessage, "arthroscopy" | "instruments">,
): Lesson | undefined {
  if (exercise.instruments.some(({ skin_work }) => skin_work !== "none")) return undefined;
  return exercise.arthroscopy === null ? BONE_LESSON : SCOPE_LESSON;
}

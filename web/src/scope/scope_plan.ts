// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an arthroscopy goes by, as the host says it. Pure.
import type { ExerciseMessage } from "../protocol";

export type Plan = NonNullable<ExerciseMessage["arthroscopy"]>;

/** In which the disc lies. */
export const DISC_JOINT = "radiocarpal";

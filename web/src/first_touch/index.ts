// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A guided first ninety seconds.
export { FirstTouchCard } from "./first_touch_card";
export type { Observation } from "./first_touch_model";
export { lessonOf } from "./lesson_of";

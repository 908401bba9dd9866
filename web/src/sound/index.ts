// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is heard in the theatre.
export { Sound, type SoundState } from "./sound";
export type { Heard } from "./sound_model";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A gamepad as the hand.
export { GamepadHand, type PadRoom } from "./gamepad_hand";
export type { DialogStep } from "./pad_model";

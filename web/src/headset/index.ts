// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A headset as eyes and hands.
export { Headset, headsetIsThere, type HeadsetHandlers } from "./headset";
export type { HeadsetOnce } from "./controller_model";
export type { Words } from "./word_plate";

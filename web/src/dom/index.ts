// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Building elements.
export * from "./element";
export { drawsInSoftware } from "./draws_in_software";
export { lostPicture } from "./lost_picture";
export { remember, remembered } from "./remembered";
export { whileHeld } from "./while_held";

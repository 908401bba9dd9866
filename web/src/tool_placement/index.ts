// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the hand holds the instrument, as the page asks for it.
export * from "./vectors";
export * from "./tool_pose";
export * from "./at_skin";
export * from "./taken_over";
export * from "./held_key_speed";
export * from "./key_steps";

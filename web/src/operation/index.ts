// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the trainee can do and what comes next.
export * from "./key_help";
export * from "./key_map";
export * from "./offered_actions";
export * from "./held_items";
export * from "./tick_text";
export * from "./why_still";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the trainee can do and what comes next.
export * from "./key_map";
export * from "./step_guide";
export * from "./tick_text";

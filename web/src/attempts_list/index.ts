// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Past attempts.
export { mountAttempts } from "./attempts_page";
export { dateText, durationText, procedureText } from "./attempts_model";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The truth about one attempt.
export { mountScore } from "./score_page";
export { GRADE_SIGNS, GRADE_WORDS, valueText } from "./score_model";

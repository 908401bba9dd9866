// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The view quiz: where is the screw, and which view would tell?
export { mountViewQuiz } from "./quiz_page";
export { polygonPoints } from "./quiz_model";

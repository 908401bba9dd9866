// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Closed skin that is worked on: what hands feel there.
export * from "./skin_desk";
export * from "./skin_words_model";

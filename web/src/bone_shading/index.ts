// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How deep in the folds between the bones each point lies.
export * from "./vertex_occlusion";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of the page.
export * from "./patient_to_renderer";

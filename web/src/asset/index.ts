// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a person rates an arthroscopy, beside the program's score.
export { assetSection } from "./asset_section";
export { summaryText as assetText } from "./asset_model";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys, shown over the screen they act on.
export { HelpOverlay } from "./help_overlay";

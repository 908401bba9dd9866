// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The first screen.
export { StartDialog, type StartChoice } from "./start_dialog";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An instructor prepares what is wrong in a case's joints.
export { PathologyDialog } from "./pathology_dialog";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Stored attempts, looked at again.
export { mountReplay } from "./replay_page";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The room where one operates.
export { mountTrain } from "./mount_train";

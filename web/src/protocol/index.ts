// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The messages between page and host: generated from protocol/protocol.json, and the one part that
// a schema of JSON messages cannot say: the picture frame.
export * from "./generated";
export { type Parsed } from "./validator";
export { parseCArmPicture, type CArmPicture } from "./c_arm_picture";

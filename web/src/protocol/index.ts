// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The messages between page and host: generated from protocol/protocol.json, and the two parts that
// a schema of JSON messages cannot say: the picture frame and the list of views.
export * from "./generated";
export { parseCArmPicture, type CArmPicture } from "./c_arm_picture";
export { parseViews, type NamedView } from "./named_views";

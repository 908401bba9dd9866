// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The C-arm's panel.
export { CArmPanel, type CArmHandlers } from "./c_arm_panel";
export { Monitor } from "./monitor";
export type { Pedal } from "./pedal";
export { viewName } from "./view_name_model";
export { drawPicture } from "./picture_canvas";

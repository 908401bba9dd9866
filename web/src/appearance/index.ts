// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
export { AppearancePanel } from "./appearance_panel";
export {
  defaultLook,
  hexOf,
  materialOf,
  MOST_LAMPS,
  roughnessOf,
  type Lamp,
  type Look,
  type Material,
  type Rgb,
  type Tissue,
} from "./look_model";

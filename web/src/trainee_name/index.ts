// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who sits here: what a name may be, and the last one, kept on the device.
export { nameProblem } from "./name_model";
export { nameField, rememberedName, rememberName } from "./name_field";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The 3-D view: bones, skin, instruments, contact.
export { Theatre, VIEWS, type ViewId } from "./theatre";
export { loadCaseScene, type CaseScene } from "./case_scene";
export { boneMaterial, glassBoneMaterial, metalMaterial } from "./materials";
export { studioLight } from "./light";
export { screwGeometry, wireGeometry, alignShaft, WIRE_LENGTH_MM } from "./instruments";
export { backdrop } from "./backdrop";

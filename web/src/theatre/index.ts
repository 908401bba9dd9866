// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The 3-D view: bones and what was drilled out of them, skin, instruments, contact.
export { Theatre } from "./theatre";
export { nextCut, type Cut } from "./cut_plane_model";
export type { WornStage } from "./worn_stage";
export { VIEWS, type ViewId } from "./sight";
export { loadCaseScene, type CaseScene } from "./case_scene";
export { glassBoneMaterial } from "./materials";
export { studioLight, type StudioLight } from "./light";
export { alignShaft, drawInstrument } from "./instruments";

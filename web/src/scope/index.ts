// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The arthroscope: its picture, and the two hands that lead what goes into the joint.
export type { ForceGrade } from "./force_limits";
export { ScopeDesk, type ScopeRoom } from "./scope_desk";
export { jointWallOf, type JointWall } from "./joint_wall";
export { ScopeReplay, type ScopeMoment } from "./scope_replay";
export { PadAtScope } from "./second_lead";

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The thesis's arm and law as they were [yaacoub2008] chapter 6, appendix B: a serial arm with a
// potentiometer and a servo at each joint, no slot; a card of 12 bits; at every frame of 20 ms the
// tool's place and, by the thesis's linear program, whether it meets the bone. Apart: no pulses.
// Meeting: pulses.
//
// The thesis does not say which pulse. Here each servo is told to hold the joint where the
// collision was found: any other angle that can be known then either gives way or hunts.
//
// The same law on drive B, to compare: the delta's motors, off or holding that place by a spring of
// the given stiffness, at the same 20 ms.
#pragma once

#include <memory>

#include "device_bench/rig.hpp"

namespace carpus::device_bench {

[[nodiscard]] std::unique_ptr<Rig> make_thesis_rig(const RigOptions& options);

}  // namespace carpus::device_bench

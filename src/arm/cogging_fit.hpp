// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Cogging of drive B's motors from how the legs speed up and slow down while a hand leads the arm
// about with the motors off: at some 40 to 100 Hz, where nothing but rotor and leg takes it up.
#pragma once

#include <span>

#include "arm/cogging.hpp"
#include "core/result.hpp"

namespace carpus::arm {

/// A rotor of 5 kg mm2 behind 10:1, and the leg: what cogging accelerates, by the parts list. The
/// amplitude is as wrong as this is; the phase does not depend on it.
inline constexpr double kMotorLegInertiaKgMm2 = 660;

/// @param angles  of the legs, a sample each millisecond [rad]; some seconds. @return a refusal
/// that says which leg was moved too little.
[[nodiscard]] Result<Cogging> fit_cogging(std::span<const LegAngles> angles);

}  // namespace carpus::arm

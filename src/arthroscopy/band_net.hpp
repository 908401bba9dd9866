// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A ligament of a case as a net that yields: whole, attenuated or torn (Geissler). Frame Bone of
// its first body, which is frame Patient as scanned.
#pragma once

#include <string>

#include "arthroscopy/band_table.hpp"
#include "cases/joint_lesions.hpp"
#include "cases/ligament_band.hpp"
#include "yielding/net.hpp"

namespace carpus::arthroscopy {

/// By the grade that `lesions` have laid on it. @param lesions  of an examination; or nullptr.
[[nodiscard]] yielding::Net band_net(const cases::LigamentBand& band,
                                     const cases::JointLesions* lesions);

/// Of this grade. @param tear  the lesion along which it is torn; nullptr: it is not
[[nodiscard]] yielding::Net band_net(const cases::LigamentBand& band,
                                     const BandGrade& grade,
                                     const cases::Lesion* tear);

}  // namespace carpus::arthroscopy

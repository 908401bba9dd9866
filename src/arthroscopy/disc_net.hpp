// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The disc of a case as a sheet that yields, whole or come off the fovea. Frame Patient as scanned,
// which is frame Bone of the forearm.
#pragma once

#include "cases/arthroscopic_map.hpp"
#include "cases/joint_lesions.hpp"
#include "yielding/net.hpp"

namespace carpus::arthroscopy {

/// Half of the disc's thickness [S76: 1.4 mm]: its middle lies so far below the joint's wall.
inline constexpr double kHalfDiscMm = 0.7;

/// Of the disc's grades in data/pathology.json, that which is slack.
inline constexpr const char* kOffTheFovea = "1B";
/// The tour's point (data/portals.json) at the edge that a hook test pulls at.
inline constexpr int kHookTestPoint = 16;  // [K, B8]

/// Without particles where the case has no disc. @param lesions  of an examination; or nullptr.
[[nodiscard]] yielding::Net disc_net(const cases::ArthroscopicMap& map,
                                     const cases::JointLesions* lesions);

}  // namespace carpus::arthroscopy

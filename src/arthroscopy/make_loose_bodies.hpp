// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies that lie loose in a case's joints, by a seed: where each lies at first, on the wall by a
// place of the tour. The same seed on the same case gives the same bits everywhere. Generated.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "cases/joint_lesions.hpp"

namespace carpus::arthroscopy {

/// Of its radius a body's middle lies above the wall on which it rests [E].
inline constexpr double kLiesAboveShare = 0.9;

struct LooseBodyChoice {
  std::array<std::uint8_t, 2> bodies{};  ///< least and most
  std::array<double, 2> radius_mm{};     ///< least and most [mm]
  std::span<const std::uint8_t> places;  ///< of the tour, by their numbers
};

/// Places in frame Patient as scanned [mm], on the walls of the map's joints. Fewer where the case
/// lacks the places, none where it lacks all of them.
[[nodiscard]] cases::JointLesions make_loose_bodies(const cases::CaseData& data,
                                                    const cases::ArthroscopicMap& map,
                                                    const LooseBodyChoice& choice,
                                                    std::uint64_t seed);

}  // namespace carpus::arthroscopy

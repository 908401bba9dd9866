// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a shaver is to take away in a case's joints, by a seed: tufts of inflamed synovium about
// places of the tour, or the frayed edges of a torn disc. The same seed on the same case gives the
// same bits everywhere. Generated.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "cases/joint_lesions.hpp"

namespace carpus::arthroscopy {

struct SynovitisChoice {
  std::array<std::uint8_t, 2> patches{};  ///< least and most
  std::array<std::uint8_t, 2> tufts{};    ///< of each
  std::span<const std::uint8_t> places;   ///< of the tour, by their numbers
};

struct TornDiscChoice {
  std::span<const std::string> tears;  ///< grades of the pathology table, by id
  double frayed_mm = 0;                ///< so far about the tear its edges are loose
  double rim_mm = 0;                   ///< of the disc's own edge that must stay
};

/// Frame Patient as scanned [mm]. Fewer patches where the case lacks the places.
[[nodiscard]] cases::JointLesions make_synovitis(const cases::CaseData& data,
                                                 const cases::ArthroscopicMap& map,
                                                 const SynovitisChoice& choice,
                                                 std::uint64_t seed);

/// A tear of the disc, which is a lesion too, and a piece for each of the disc's particles, in
/// their order. Without pieces where the case has no disc.
[[nodiscard]] cases::JointLesions make_torn_disc(const cases::CaseData& data,
                                                 const cases::ArthroscopicMap& map,
                                                 const TornDiscChoice& choice,
                                                 std::uint64_t seed);

}  // namespace carpus::arthroscopy

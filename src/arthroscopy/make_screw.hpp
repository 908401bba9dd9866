// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A headless screw laid into a case's scaphoid from its proximal pole, by a seed: well, or with one
// fault that shows in a joint (data/screw_control.json). The same seed on the same case gives the
// same bits everywhere: + - * / and sqrt alone. Generated, not in the CT.
#pragma once

#include <cstdint>
#include <span>

#include "arthroscopy/screw_table.hpp"
#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "cases/joint_lesions.hpp"

namespace carpus::arthroscopy {

/// Numbers of the tour's places by which a screw's sites are found (data/portals.json).
inline constexpr int kPoleOfScaphoid = 3;
inline constexpr int kScaphocapitate = 18;
inline constexpr int kStt = 19;

/// A screw that there is.
struct ScrewKind {
  double length_mm = 0.0;
  double tail_radius_mm = 0.0;  ///< over the thread
  double tip_radius_mm = 0.0;
};

/// The screw, its sites as lesions in their order (LesionLook::ScrewSite), and the right answers as
/// grades. A fault that the bone has no place for gives way to the next one; without a screw where
/// the bone lets none be laid, or the case lacks the places.
/// @param kinds  to choose from
[[nodiscard]] cases::JointLesions make_screw(const cases::CaseData& data,
                                             const cases::ArthroscopicMap& map,
                                             const ScrewTable& table,
                                             std::span<const ScrewKind> kinds,
                                             std::uint64_t seed);
/// By the built-in table, of all screws of data/screws.json.
[[nodiscard]] cases::JointLesions make_screw(const cases::CaseData& data,
                                             const cases::ArthroscopicMap& map,
                                             std::uint64_t seed);

}  // namespace carpus::arthroscopy

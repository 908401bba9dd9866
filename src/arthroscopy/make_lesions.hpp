// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A wrist with something wrong in it, by a seed (data/pathology.json): which findings in which
// grades, and what of it lies where on a case's joints. The same seed on the same case gives the
// same bits everywhere: + - * / and sqrt alone. Generated, never seen in a CT.
#pragma once

#include <cstdint>

#include "arthroscopy/pathology_table.hpp"
#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "cases/joint_lesions.hpp"

namespace carpus::arthroscopy {

/// Among which grades a seed draws.
enum class Drawn : std::uint8_t {
  All,
  WithoutGrades,  ///< Grade::is_drawn: what recordings that hold no grades were made with
};

/// Which grade of what: a healthy wrist for some seeds, one to several findings for the others.
[[nodiscard]] cases::Grades grades_by(std::uint64_t seed,
                                      const PathologyTable& table,
                                      Drawn among = Drawn::All);

/// Those grades on this case. A finding whose place the case lacks (no midcarpal portal, a missing
/// bone) is taken as well, and so told by the grades that come back.
/// @param seed  where within its place a patch lies.
[[nodiscard]] cases::JointLesions make_lesions(const cases::CaseData& data,
                                               const cases::ArthroscopicMap& map,
                                               const PathologyTable& table,
                                               const cases::Grades& grades,
                                               std::uint64_t seed);

}  // namespace carpus::arthroscopy

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/band_net.hpp"

#include <optional>

#include "arthroscopy/pathology_table.hpp"
#include "yielding/net_of_band.hpp"

namespace carpus::arthroscopy {

yielding::Net band_net(const cases::LigamentBand& band,
                       const BandGrade& grade,
                       const cases::Lesion* tear) {
  const BandTable& table = BandTable::generic();
  yielding::BandMaterial material;
  material.along_n_per_mm = band.along_n_per_mm * grade.along_share;
  material.aside_share = table.aside_share;
  material.tension_n_per_mm = grade.tension_n_per_mm;
  material.foundation_n_per_mm2 = grade.foundation_n_per_mm2;
  material.mass_g_per_mm2 = table.mass_g_per_mm2;
  material.damping_per_s = table.damping_per_s;
  material.bulges_mm = grade.bulge_mm;
  std::optional<yielding::BandTear> torn;
  if (tear != nullptr) torn = yielding::BandTear{tear->from, tear->to, grade.edge_share};
  return yielding::net_of_band({band.rows, band.columns, band.at, band.inwards}, material, torn);
}

yielding::Net band_net(const cases::LigamentBand& band, const cases::JointLesions* lesions) {
  const PathologyTable& wrong = PathologyTable::generic();
  const BandTable& table = BandTable::generic();
  for (const cases::Lesion& lesion :
       lesions != nullptr ? lesions->lesions : std::vector<cases::Lesion>{}) {
    // Of a screw's sites nothing is in that table.
    if (lesion.look == cases::LesionLook::ScrewSite || lesion.joint != band.joint) continue;
    if (wrong.findings[lesion.finding].id != band.id) continue;
    const BandGrade* grade = table.grade(wrong.scale_of(lesion.finding).grades[lesion.grade].id);
    if (grade == nullptr) continue;
    const bool is_torn = lesion.look == cases::LesionLook::Tear;
    return band_net(band, *grade, is_torn ? &lesion : nullptr);
  }
  return band_net(band, table.grades.front(), nullptr);
}

}  // namespace carpus::arthroscopy

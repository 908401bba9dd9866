// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/disc_net.hpp"

#include "arthroscopy/disc_table.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "yielding/net_of_sheet.hpp"

namespace carpus::arthroscopy {

yielding::Net disc_net(const cases::ArthroscopicMap& map, const cases::JointLesions* lesions) {
  if (map.disc_sheet.vertices.empty()) return {};
  const PathologyTable& table = PathologyTable::generic();
  const DiscTable& disc = DiscTable::generic();
  for (const cases::Lesion& lesion :
       lesions != nullptr ? lesions->lesions : std::vector<cases::Lesion>{}) {
    if (lesion.look == cases::LesionLook::ScrewSite) continue;
    if (table.scale_of(lesion.finding).grades[lesion.grade].id != kOffTheFovea) continue;
    const yielding::ComeOff off{lesion.from, lesion.to, disc.off_radius_mm, disc.off_left_share,
                                disc.published.rests_off_mm};
    return yielding::net_of_sheet(map.disc_sheet, map.distal, disc.material, disc.spacing_mm, &off);
  }
  return yielding::net_of_sheet(map.disc_sheet, map.distal, disc.material, disc.spacing_mm);
}

}  // namespace carpus::arthroscopy

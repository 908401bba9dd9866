// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/disc_net.hpp"

#include "arthroscopy/pathology_table.hpp"
#include "yielding/net_of_sheet.hpp"

namespace carpus::arthroscopy {
namespace {

/// So that 1 N of a probe presses the middle in by 0.6 mm: its rebound intact [S78]; that this was
/// at about 1 N is [E].
constexpr yielding::SheetMaterial kDisc{16.0, 0.25, 0.8, 60.0};
constexpr double kSpacingMm = 0.8;
constexpr double kOffMm = 3.2;       // about the tear [E]
constexpr double kLeftShare = 0.05;  // of what lay under it and holds it still [E]
constexpr double kRestsOffMm = 1.3;  // resting offset of a detached disc [S78]

}  // namespace

yielding::Net disc_net(const cases::ArthroscopicMap& map, const cases::JointLesions* lesions) {
  if (map.disc_sheet.vertices.empty()) return {};
  const PathologyTable& table = PathologyTable::generic();
  for (const cases::Lesion& lesion :
       lesions != nullptr ? lesions->lesions : std::vector<cases::Lesion>{}) {
    if (lesion.look == cases::LesionLook::ScrewSite) continue;
    if (table.scale_of(lesion.finding).grades[lesion.grade].id != kOffTheFovea) continue;
    const yielding::ComeOff off{lesion.from, lesion.to, kOffMm, kLeftShare, kRestsOffMm};
    return yielding::net_of_sheet(map.disc_sheet, map.distal, kDisc, kSpacingMm, &off);
  }
  return yielding::net_of_sheet(map.disc_sheet, map.distal, kDisc, kSpacingMm);
}

}  // namespace carpus::arthroscopy

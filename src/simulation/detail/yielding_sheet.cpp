// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/yielding_sheet.hpp"

#include <algorithm>

#include "arthroscopy/band_net.hpp"
#include "arthroscopy/disc_net.hpp"

namespace carpus::simulation::detail {
namespace {

constexpr double kDiscGivesMm = 4.0;  // then the ulna is under it
constexpr double kBandGivesMm = 2.5;  // then the rims of the bones are about the tip [E]

void bound(YieldingSheet& sheet) {
  const std::vector<Vec3>& places = sheet.net.scanned();
  if (places.empty()) return;
  Vec3 sum;
  for (const Vec3& at : places) sum += at;
  sheet.middle = sum / static_cast<double>(places.size());
  for (const Vec3& at : places) {
    sheet.reach_mm = std::max(sheet.reach_mm, distance(at, sheet.middle));
  }
}

}  // namespace

std::vector<YieldingSheet> yielding_sheets(const cases::CaseData& data,
                                           const cases::ArthroscopicMap& map,
                                           const cases::JointLesions* lesions) {
  std::vector<YieldingSheet> sheets;
  YieldingSheet disc;
  disc.net = arthroscopy::disc_net(map, lesions);
  disc.first = disc.second = map.forearm;
  disc.half_thick_mm = arthroscopy::kHalfDiscMm;
  disc.most_gives_mm = kDiscGivesMm;
  sheets.push_back(std::move(disc));
  for (const cases::LigamentBand& band : map.bands) {
    if (sheets.size() == kMaxSheets) break;
    YieldingSheet sheet;
    sheet.net = arthroscopy::band_net(band, lesions);
    sheet.first = band.first;
    sheet.second = band.second;
    sheet.joint = band.joint;
    sheet.interval = arthroscopy::interval_of(data, map, band);
    sheet.half_thick_mm = band.thickness_mm / 2;
    sheet.most_gives_mm = kBandGivesMm;
    sheets.push_back(std::move(sheet));
  }
  for (YieldingSheet& sheet : sheets) bound(sheet);
  return sheets;
}

}  // namespace carpus::simulation::detail

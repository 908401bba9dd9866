// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/yielding_figures.hpp"

#include <algorithm>
#include <memory>
#include <span>

#include "arthroscopy/band_net.hpp"
#include "arthroscopy/band_table.hpp"
#include "arthroscopy/disc_net.hpp"
#include "arthroscopy/make_lesions.hpp"
#include "arthroscopy/named_grades.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "yielding/net_of_band.hpp"
#include "yielding/net_state.hpp"

namespace carpus::arthroscopy {
namespace {

constexpr double kProbeMm = 0.5;  // radius of the hook probe [K, B9]
constexpr int kTicks = 2000;      // until it rests
constexpr double kMmPerN = 0.01;  // a tick: as a hand sinks in
constexpr double kNewtons = 1.0;

DiscFigures figures_of(const yielding::Net& net, const Vec3& middle, const Vec3& edge) {
  DiscFigures made;
  made.press_mm = pressed_in_mm(net, middle, kHalfDiscMm, kNewtons);
  made.lifted_mm = lifted_mm(net, edge, kNewtons);
  made.particles = net.size();
  return made;
}

}  // namespace

double pressed_in_mm(const yielding::Net& net,
                     const Vec3& at,
                     double half_thick_mm,
                     double newtons) {
  const auto state = std::make_unique<yielding::NetState>();
  state->reset(net);
  const std::size_t near = state->nearest(net, at);
  if (near >= net.size()) return 0;
  const Vec3 normal = net.normals()[near];
  yielding::Tip tip;
  tip.is_there = true;
  tip.radius_mm = kProbeMm + half_thick_mm;
  double deep = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    tip.at = net.rest()[near] + normal * (tip.radius_mm - deep);
    state->step(net, std::span<const yielding::Tip>(&tip, 1));
    deep += kMmPerN * (newtons - dot(state->force_on(0), normal));
  }
  return deep;
}

double lifted_mm(const yielding::Net& net, const Vec3& at, double newtons) {
  const auto state = std::make_unique<yielding::NetState>();
  state->reset(net);
  yielding::Tip tip;
  tip.is_there = true;
  tip.hooked = state->nearest(net, at);
  if (tip.hooked >= net.size()) return 0;
  const Vec3 normal = net.normals()[tip.hooked];
  double lift = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    tip.at = net.rest()[tip.hooked] + normal * lift;
    state->step(net, std::span<const yielding::Tip>(&tip, 1));
    lift += kMmPerN * (newtons + dot(state->force_on(0), normal));
  }
  return dot(state->off(tip.hooked), normal);
}

std::vector<DiscFigures> disc_figures(const cases::CaseData& data,
                                      const cases::ArthroscopicMap& map) {
  const yielding::Net whole = disc_net(map, nullptr);
  if (whole.size() == 0) return {};
  Vec3 middle;
  for (const Vec3& at : whole.rest()) middle += at / static_cast<double>(whole.size());
  Vec3 edge = middle;
  for (const cases::TourPoint& point : map.points) {
    if (point.number == kHookTestPoint) edge = point.at;
  }
  std::vector<DiscFigures> all{figures_of(whole, middle, edge)};
  const PathologyTable& table = PathologyTable::generic();
  cases::Grades torn{};
  if (!set_grade(torn, table, "disc", kOffTheFovea)) return all;
  const cases::JointLesions lesions = make_lesions(data, map, table, torn, 1);
  if (lesions.grades != torn) return all;
  const yielding::Net off = disc_net(map, &lesions);
  DiscFigures made = figures_of(off, middle, edge);
  made.has_come_off = true;
  for (std::size_t i = 0; i < std::min(whole.size(), off.size()); ++i) {
    made.rests_off_mm = std::max(made.rests_off_mm, distance(whole.rest()[i], off.rest()[i]));
  }
  all.push_back(made);
  return all;
}

std::vector<BandFigures> band_figures(const cases::ArthroscopicMap& map) {
  const BandTable& table = BandTable::generic();
  std::vector<BandFigures> all;
  for (const cases::LigamentBand& band : map.bands) {
    for (const BandGrade& grade : table.grades) {
      if (!grade.press_mm) continue;
      const yielding::Net net = band_net(band, grade, nullptr);
      const std::size_t middle = (band.rows / 2) * band.columns + band.columns / 2;
      BandFigures made;
      made.band = band.id;
      made.grade = grade.id;
      made.press_mm = pressed_in_mm(net, net.rest()[middle], band.thickness_mm / 2, 1.0);
      made.wanted_mm = grade.press_mm;
      made.bulge_mm = grade.bulge_mm;
      made.fibres_n_per_mm = band.along_n_per_mm * grade.along_share;
      made.along_n_per_mm =
          yielding::along_n_per_mm(net, {band.rows, band.columns, band.at, band.inwards});
      for (const TabledBand& each : table.bands) {
        if (each.id == band.id) made.whole_n_per_mm = each.whole_n_per_mm;
      }
      made.particles = net.size();
      made.springs = net.springs().size();
      all.push_back(std::move(made));
    }
  }
  return all;
}

}  // namespace carpus::arthroscopy

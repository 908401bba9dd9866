// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopy/shaving.hpp"

#include <algorithm>
#include <bit>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"
#include "procedures/arthroscopy/hand_measures.hpp"
#include "procedures/arthroscopy/punching.hpp"

namespace carpus::procedures::arthroscopy {
namespace {

using procedure::Measure;

constexpr double kPercent = 100.0;

Measure share_of(const char* id, double part, double whole) {
  Measure measure{id, {}, ""};
  if (whole > 0) measure.value = kPercent * part / whole;
  return measure;
}

std::string of(std::uint32_t part, std::uint32_t whole) {
  return std::to_string(part) + " of " + std::to_string(whole) + " pieces.";
}

}  // namespace

bool has_worked(const procedure::ShavingFacts& done) noexcept {
  return done.ill > 0 && 2 * done.ill_removed >= done.ill;
}

std::vector<Measure> shaving_measures(const procedure::ShavingFacts& done) {
  std::vector<Measure> measures;
  measures.push_back(share_of("ill_removed_share", done.ill_removed, done.ill));
  if (done.ill > 0) measures.back().finding = of(done.ill_removed, done.ill);
  measures.push_back(share_of("sound_removed_share", done.sound_removed, done.sound));
  if (done.sound > 0) measures.back().finding = of(done.sound_removed, done.sound);
  const auto seconds = [](std::uint32_t ticks) { return ticks * kTickSeconds; };
  measures.push_back({"rim_removed", static_cast<double>(done.rim_removed), ""});
  measures.push_back(share_of("ran_unseen_share", done.unseen_ticks, done.running_ticks));
  // All of it came off by a punch: a shaver that never ran never ran unseen.
  if (done.running_ticks == 0) measures.back().value = 0.0;
  measures.push_back({"ran_on_cartilage_s", seconds(done.cartilage_ticks), ""});
  measures.push_back({"ran_on_lining_s", seconds(done.lining_ticks), ""});
  measures.push_back({"ran_against_scope_s", seconds(done.scope_ticks), ""});
  measures.push_back({"ran_in_the_way_s", seconds(done.way_ticks), ""});
  measures.push_back({"looked_again", static_cast<double>(std::popcount(done.seen_since)), ""});
  if (has_worked(done)) return measures;
  for (std::size_t i = 1; i < measures.size(); ++i) measures[i].value.reset();
  return measures;
}

procedure::Opening open_to_shave(const cases::CaseData& data,
                                 const procedure::Shaving& shaving,
                                 std::string_view name) {
  procedure::Opening opened = opening(data, name);
  if (shaving.disc && data.arthroscopy->disc_sheet.vertices.empty()) {
    throw InvalidInput(std::string(name) + ": this wrist has no disc; choose another case");
  }
  if (!shaving.synovium) return opened;
  const auto& points = data.arthroscopy->points;
  const auto& places = shaving.synovium->places;
  const auto there = std::count_if(points.begin(), points.end(), [&](const auto& point) {
    return std::find(places.begin(), places.end(), point.number) != places.end();
  });
  if (there < shaving.synovium->patches[1]) {
    throw InvalidInput(std::string(name) +
                       ": this wrist has too few of the places at which synovium may be "
                       "inflamed; choose another case");
  }
  return opened;
}

procedure::ScoreReport score_shaving(const cases::CaseData& data,
                                     const procedure::Procedure& procedure,
                                     const procedure::OperationRecord& record) {
  std::vector<Measure> measures = conduct_measures(data, procedure, record);
  const procedure::ScopeFacts facts = record.scope ? record.scope->facts : procedure::ScopeFacts{};
  for (Measure& each : shaving_measures(facts.shaving)) measures.push_back(std::move(each));
  for (Measure& each : punch_measures(facts.punch, has_worked(facts.shaving))) {
    measures.push_back(std::move(each));
  }
  if (procedure.fluid) add_fluid_measures(measures, record);
  procedure::ScoreReport report;
  procedure::grade(report, procedure.rules, measures);
  tell_scuffs(report, data, record);
  return report;
}

}  // namespace carpus::procedures::arthroscopy

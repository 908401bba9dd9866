// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Points and cartilage that were truly seen, how both hands went, force, what lay in the ways in.
#include "procedures/arthroscopy/conduct.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "arthroscopy/seen_share.hpp"
#include "procedure/harm_measures.hpp"
#include "procedure/thrift_measures.hpp"
#include "procedures/arthroscopy/hand_measures.hpp"

namespace carpus::procedures::arthroscopy {
namespace {

using procedure::Measure;

double seconds(Tick ticks) { return static_cast<double>(ticks) * kTickSeconds; }

/// Whether any of its portals leads to where the point lies: where they are made, those alone.
bool is_reachable(const cases::ArthroscopicMap& map,
                  const procedure::OperationRecord& record,
                  const cases::TourPoint& point) {
  if (!record.making) return true;
  const auto& asked = record.making->asked;
  return std::any_of(asked.begin(), asked.end(), [&](std::uint8_t portal) {
    return portal < map.portals.size() && map.portals[portal].joint == point.joint;
  });
}

/// What of the tour was not seen, in words.
std::string missing(const cases::ArthroscopicMap& map,
                    const procedure::OperationRecord& record,
                    std::uint32_t seen) {
  std::string names;
  for (const cases::TourPoint& point : map.points) {
    if ((seen >> point.number & 1U) != 0 || !is_reachable(map, record, point)) continue;
    names += (names.empty() ? "" : ", ") + point.name;
  }
  return names.empty() ? "All of them." : "Not seen: " + names + ".";
}

Measure cartilage(const cases::CaseData& data, const procedure::ScopeRecord& scope) {
  const carpus::arthroscopy::SeenCartilage seen =
      carpus::arthroscopy::seen_by(data, *data.arthroscopy, scope.looks, scope.least_cosine);
  std::string finding;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    const double share = seen.share_of(static_cast<std::uint8_t>(b));
    if (!(share > 0)) continue;
    finding += (finding.empty() ? "" : ", ") + std::string(name_of(data.bones[b].bone)) + " " +
               procedure::text_of(share * 100) + " %";
  }
  return {"cartilage_seen_share", seen.share() * 100, finding.empty() ? finding : finding + "."};
}

constexpr const char* kNeverIn = "No scope went in.";

/// How what was in a joint was led there; who never went in proved no care by it.
void add_care(std::vector<Measure>& measures, const procedure::ScopeRecord& scope) {
  const std::size_t first = measures.size();
  measures.push_back({"pull_outs", static_cast<double>(scope.pull_outs), ""});
  measures.push_back({"capsule_pushes", static_cast<double>(scope.capsule_pushes), ""});
  measures.push_back({"force_over_3_n_s", seconds(scope.warn_ticks),
                      "At most " + procedure::text_of(scope.most_force_n) + " N."});
  measures.push_back({"force_over_8_n_s", seconds(scope.injury_ticks), ""});
  if (scope.entries > 0) return;
  for (std::size_t i = first; i < measures.size(); ++i) {
    measures[i].value.reset();
    measures[i].finding = kNeverIn;
  }
}

/// What the ways from the skin into the joint led through or beside.
void add_ways_in(std::vector<Measure>& measures,
                 const cases::CaseData& data,
                 const procedure::OperationRecord& record) {
  const bool has_entered = record.scope && record.scope->entries > 0;
  Measure struck = procedure::structures_struck(data, record, " went in through the ",
                                                procedure::ThroughSkin::Portal);
  if (!has_entered) {
    struck.value.reset();
    struck.finding = kNeverIn;
  }
  measures.push_back(std::move(struck));
  for (Measure& near : procedure::nearest_structures(data, record, "Nothing went in near one.")) {
    measures.push_back(std::move(near));
  }
}

}  // namespace

std::vector<Measure> conduct_measures(const cases::CaseData& data,
                                      const procedure::Procedure& procedure,
                                      const procedure::OperationRecord& record) {
  static const procedure::ScopeRecord kNone;
  const procedure::ScopeRecord& scope = record.scope ? *record.scope : kNone;

  std::vector<Measure> measures = procedure::thrift_measures(procedure, record, {});
  const auto count = [](std::uint32_t bits) { return static_cast<double>(std::popcount(bits)); };
  const bool has_map = data.arthroscopy != nullptr;
  measures.push_back({"points_seen", count(scope.facts.points_seen),
                      has_map ? missing(*data.arthroscopy, record, scope.facts.points_seen) : ""});
  Measure share{"points_seen_share", {}, ""};
  if (has_map && !data.arthroscopy->points.empty()) {
    const auto all = static_cast<double>(data.arthroscopy->points.size());
    share.value = count(scope.facts.points_seen) / all * 100;
    share.finding =
        "Of " + std::to_string(data.arthroscopy->points.size()) + " that this wrist has.";
  }
  measures.push_back(std::move(share));
  measures.push_back({"points_probed", count(scope.facts.points_probed), ""});
  measures.push_back(has_map ? cartilage(data, scope) : Measure{"cartilage_seen_share", {}, ""});
  measures.push_back({"scope_path_mm", scope.path_mm[0], ""});
  measures.push_back({"probe_path_mm", scope.path_mm[1], ""});
  measures.push_back(smoothness("scope_smoothness", scope.smoothness[0]));
  measures.push_back(smoothness("probe_smoothness", scope.smoothness[1]));
  measures.push_back(cartilage_scuffs(data, scope));
  add_care(measures, scope);
  const double looked = seconds(scope.looking_ticks);
  Measure horizon{"horizon_off_share", {}, ""};
  if (looked > 0) horizon.value = seconds(scope.tilted_ticks) / looked * 100;
  measures.push_back(std::move(horizon));
  measures.push_back({"looking_s", looked, ""});
  add_ways_in(measures, data, record);
  return measures;
}

}  // namespace carpus::procedures::arthroscopy

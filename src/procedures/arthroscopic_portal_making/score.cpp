// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where needle and sheath went in against the portal of this case's map, the cut, what was felt
// first, what was struck (docs/scoring.md defines each). Care is praised once both are made: who
// does nothing harms nothing.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/find_structure.hpp"
#include "cases/laid_structures.hpp"
#include "core/units.hpp"
#include "procedure/harm_measures.hpp"
#include "procedure/thrift_measures.hpp"
#include "procedures/arthroscopic_portal_making/declared.hpp"

namespace carpus::procedures::arthroscopic_portal_making {
namespace {

using procedure::Measure;
using procedure::PortalMade;
using procedure::text_of;
using procedure::WayMade;

double degrees_of(double cosine) {
  return degrees_from_radians(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

double off_mm(const WayMade& way) { return std::max(way.skin_off_mm, way.inner_off_mm); }

std::string places(const WayMade& way) {
  return text_of(way.skin_off_mm) + " mm at the skin, " + text_of(way.inner_off_mm) +
         " mm at the capsule.";
}

/// Ids of one portal's measures.
struct PortalIds {
  std::string_view needle;
  std::string_view tilt;
  std::string_view sheath;
  std::string_view length;
  std::string_view depth;
};
constexpr PortalIds kFirst{"first_needle_off_mm", "first_needle_tilt_deg", "first_sheath_off_mm",
                           "first_cut_length_mm", "first_cut_depth_mm"};
constexpr PortalIds kSecond{"second_needle_off_mm", "second_needle_tilt_deg",
                            "second_sheath_off_mm", "second_cut_length_mm", "second_cut_depth_mm"};

void add_portal(std::vector<Measure>& measures,
                const PortalIds& ids,
                const PortalMade& made,
                bool is_made) {
  Measure needle{ids.needle, {}, ""};
  Measure tilt{ids.tilt, {}, ""};
  // A needle that found the joint after the sheath led to nothing; one that never did, neither.
  if (is_made && made.needle.is_in) {
    needle.value = off_mm(made.needle);
    needle.finding = places(made.needle);
    tilt.value = degrees_of(made.needle.tilt_cosine);
  }
  Measure sheath{ids.sheath, {}, ""};
  Measure length{ids.length, {}, ""};
  Measure depth{ids.depth, {}, ""};
  if (is_made) {
    sheath.value = off_mm(made.sheath);
    sheath.finding = places(made.sheath);
    length.value = made.cut.length_mm;
    depth.value = made.cut.deepest_mm;
  }
  for (Measure* each : {&needle, &tilt, &sheath, &length, &depth}) {
    measures.push_back(std::move(*each));
  }
}

/// Of the two places that are felt for each counts half.
double felt_share(const PortalMade& made, int cells) {
  const auto share = [cells](std::uint16_t felt) {
    return std::min(1.0, static_cast<double>(std::popcount(felt)) / cells);
  };
  return (share(made.landmark_felt) + share(made.place_felt)) / 2;
}

std::string words_of(const cases::Structure& structure,
                     const procedure::NearStructure& near,
                     const procedure::PortalLandmark& portal) {
  if (near.was_struck) return structure.name + " struck";
  const auto& aside = portal.draws_aside;
  if (std::find(aside.begin(), aside.end(), structure.id) != aside.end()) {
    return structure.name + " not struck";  // of what went by it while drawn aside nothing is kept
  }
  // A tendon gives way to what is thin or blunt.
  if (near.least_mm < 0.0) return structure.name + " pushed aside";
  return structure.name + " " + text_of(near.least_mm) + " mm";
}

/// How near anything came to the nerves and arteries that a portal endangers; its tendons, which
/// are pushed aside, are told with them.
Measure endangered(std::string_view id,
                   const cases::CaseData& data,
                   const procedure::OperationRecord& record,
                   const procedure::PortalLandmark* portal,
                   bool is_made) {
  Measure measure{id, {}, ""};
  measure.applies = !data.structures.empty();
  if (portal == nullptr) return measure;
  for (const std::string& each : portal->endangers) {
    for (const procedure::NearStructure& near : record.structures) {
      if (near.structure >= data.structures.size()) continue;
      const cases::Structure& structure = data.structures[near.structure];
      if (structure.id != each || !(near.least_mm < cases::kFarFromStructureMm)) continue;
      if (is_made && structure.kind != anatomy::StructureKind::Tendon) {
        measure.value = std::min(measure.value.value_or(near.least_mm), near.least_mm);
      }
      measure.finding +=
          measure.finding.empty()
              ? "Nearest in this operation, of what lies beside " + portal->portal + ": "
              : ", ";
      measure.finding += words_of(structure, near, *portal);
    }
  }
  if (!measure.finding.empty()) measure.finding += ".";
  return measure;
}

/// What lies where a case of an older program has nothing was not spared for all that anyone knows.
void leave_unjudged(Measure& struck,
                    const PortalMade& made,
                    const procedure::PortalLandmark* portal,
                    const cases::CaseData& data) {
  if (portal == nullptr || !portal->judged_mm || !(made.strayed_mm > *portal->judged_mm)) return;
  const std::string lacking = cases::lacking(data.structures);
  if (lacking.empty()) return;
  struck.finding += " At " + portal->portal + " something went in " + text_of(made.strayed_mm) +
                    " mm off its way. Beyond " + text_of(*portal->judged_mm) + " mm lies " +
                    portal->beyond + ". Of these and others this case lacks: " + lacking +
                    "; whether they were harmed nobody can say. 'carpus soft-tissue' adds them.";
  if (struck.value && *struck.value <= 0.0) struck.value.reset();
}

/// Those that were asked for, in order.
std::array<const procedure::PortalLandmark*, procedure::kPortalsMade> asked_landmarks(
    const procedure::PortalMaking& making,
    const cases::CaseData& data,
    const procedure::MakingFacts& facts) {
  std::array<const procedure::PortalLandmark*, procedure::kPortalsMade> found{};
  if (data.arthroscopy == nullptr) return found;
  const std::vector<cases::Portal>& portals = data.arthroscopy->portals;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (facts.asked[i] >= portals.size()) continue;
    found[i] = procedure::landmark_of(making, portals[facts.asked[i]].id);
  }
  return found;
}

}  // namespace

std::vector<Measure> measures_of(const procedure::Procedure& graded,
                                 const cases::CaseData& data,
                                 const procedure::OperationRecord& record) {
  const procedure::MakingFacts facts = record.making.value_or(procedure::MakingFacts{});
  std::vector<Measure> measures = procedure::thrift_measures(graded, record, {});
  measures.push_back({"portals_made", static_cast<double>(facts.made), ""});
  add_portal(measures, kFirst, facts.portal[0], facts.made > 0);
  add_portal(measures, kSecond, facts.portal[1], facts.made > 1);
  double felt = 0;
  double passes = 0;
  double strikes = 0;
  double wrong = 0;
  double overrun = 0;
  double direction = 0;
  for (const PortalMade& made : facts.portal) {
    felt += felt_share(made, graded.making->cells) / procedure::kPortalsMade;
    passes += made.passes;
    strikes += made.bone_strikes;
    wrong += std::popcount(made.out_of_order);
    overrun = std::max(overrun, made.overrun_mm);
    direction = std::max(direction, degrees_of(made.cut.along_cosine));
  }
  Measure struck =
      procedure::structures_struck(data, record, " met the ", procedure::ThroughSkin::Portal);
  const auto asked = asked_landmarks(*graded.making, data, facts);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    leave_unjudged(struck, facts.portal[i], asked[i], data);
  }
  std::vector<Measure> care{
      {"palpated_share", 100 * felt, ""}, {"needle_passes", passes, ""},
      {"bone_strikes", strikes, ""},      {"out_of_order", wrong, ""},
      {"overrun_mm", overrun, ""},        {"cut_direction_deg", direction, ""}};
  care.push_back(std::move(struck));
  for (Measure& each : care) {
    if (facts.made < procedure::kPortalsMade) each.value.reset();
    measures.push_back(std::move(each));
  }
  measures.push_back(endangered("first_endangered_mm", data, record, asked[0], facts.made > 0));
  measures.push_back(endangered("second_endangered_mm", data, record, asked[1], facts.made > 1));
  for (Measure& near : procedure::nearest_structures(data, record, "Nothing came near one.")) {
    measures.push_back(std::move(near));
  }
  return measures;
}

procedure::ScoreReport scored(const procedure::Procedure& graded,
                              const cases::CaseData& data,
                              const procedure::OperationRecord& record) {
  procedure::ScoreReport report;
  procedure::grade(report, graded.rules, measures_of(graded, data, record));
  return report;
}

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  return scored(declared(), data, record);
}

}  // namespace carpus::procedures::arthroscopic_portal_making

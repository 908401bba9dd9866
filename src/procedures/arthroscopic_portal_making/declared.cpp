// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopic_portal_making/declared.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "core/error.hpp"
#include "procedure/second_portals.hpp"
#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::arthroscopic_portal_making {
namespace {

using procedure::NamedPredicate;
using procedure::Situation;

/// The least that opens a wrist [S79].
constexpr double kLeastTractionN = 34.0;
constexpr double kMostTractionN = 69.0;  // more strains nerves and skin
constexpr int kCellsFelt = 5;  // of the landmark alone: a step that knew the spot would tell it
/// The fingertip waits farther off the skin than a scope, from all of the radius [E].
constexpr double kWaitsMm = 60.0;

bool is_pulled(const Situation& now) noexcept {
  return now.wrist.traction_n >= kLeastTractionN && now.wrist.traction_n <= kMostTractionN;
}
template <std::size_t kWhich>
bool is_made(const Situation& now) noexcept {
  return now.making.made > kWhich;
}
template <std::size_t kWhich>
bool has_felt(const Situation& now) noexcept {
  return std::popcount(now.making.portal[kWhich].landmark_felt) >= kCellsFelt;
}
template <std::size_t kWhich>
bool has_needled(const Situation& now) noexcept {
  return now.making.portal[kWhich].needle.is_in;
}
template <std::size_t kWhich>
bool has_cut(const Situation& now) noexcept {
  return now.making.portal[kWhich].is_cut;
}
template <std::size_t kWhich>
bool has_spread(const Situation& now) noexcept {
  return now.making.portal[kWhich].is_spread;
}
bool is_finishing(const Situation& now) noexcept { return now.is_finishing; }

procedure::Opening opening(const cases::CaseData& data) { return opened(declared(), data); }

}  // namespace

std::span<const NamedPredicate> named_predicates() {
  static constexpr std::array kPredicates{NamedPredicate{"is_pulled", is_pulled},
                                          NamedPredicate{"has_felt_1", has_felt<0>},
                                          NamedPredicate{"has_needled_1", has_needled<0>},
                                          NamedPredicate{"has_cut_1", has_cut<0>},
                                          NamedPredicate{"has_spread_1", has_spread<0>},
                                          NamedPredicate{"is_made_1", is_made<0>},
                                          NamedPredicate{"has_felt_2", has_felt<1>},
                                          NamedPredicate{"has_needled_2", has_needled<1>},
                                          NamedPredicate{"has_cut_2", has_cut<1>},
                                          NamedPredicate{"has_spread_2", has_spread<1>},
                                          NamedPredicate{"is_made_2", is_made<1>},
                                          NamedPredicate{"is_finishing", is_finishing}};
  return kPredicates;
}

procedure::Opening opened(const procedure::Procedure& graded, const cases::CaseData& data) {
  procedure::Opening opened = arthroscopy::opening(data, "making portals");
  if (data.skin.facets.empty()) {
    throw InvalidInput("making portals: the case has no skin; choose another case");
  }
  const procedure::PortalMaking& making = *graded.making;
  if (procedure::second_portals(data, making).empty()) {
    std::string asked;
    for (const std::string& id : making.second) asked += (asked.empty() ? "" : ", ") + id;
    throw InvalidInput("making portals: this wrist has no room for a second portal, or not what " +
                       std::string("lies beside one, of: ") + asked + "; choose another case");
  }
  opened.tip_in_target = data.arthroscopy->portals.front().skin + opened.shaft_in_target * kWaitsMm;
  return opened;
}

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = [] {
    procedure::Procedure read = procedure::read_procedure(
        json(), "arthroscopic_portal_making/procedure.json", named_predicates());
    read.opening = opening;
    read.score = score;
    return read;
  }();
  return kDeclared;
}

}  // namespace carpus::procedures::arthroscopic_portal_making

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "cases/controlled_screw.hpp"
#include "core/error.hpp"
#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::arthroscopy {
namespace {

using procedure::NamedPredicate;
using procedure::Situation;

/// The least that opens a wrist [S79].
constexpr double kLeastTractionN = 34.0;
constexpr double kMostTractionN = 69.0;  // more strains nerves and skin
/// Where the hand waits, outside all tissue.
constexpr double kWaitsMm = 60.0;
/// In the order of the map's portals and joints, which opening() proves to be there.
constexpr std::uint8_t kPortal34 = 0;
constexpr std::uint8_t kPortal45 = 1;
constexpr std::uint8_t kRadiocarpal = 0;
constexpr std::uint8_t kMidcarpal = 1;
constexpr const char* kFirstJoint = "radiocarpal";
constexpr const char* kFirst = "3-4";
constexpr const char* kSecond = "4-5";

/// Of the radiocarpal portals those at whose joint's ulnar side a scope looks in dorsally: 4-5, 6R
/// and 6U, by their numbers in data/portals.json.
constexpr bool is_ulnar(std::uint8_t number) noexcept {
  return number == 1 || number == 2 || number == 6;
}

/// Whether a hand holds the scope, or what is none, in this joint, by a portal that is asked for.
template <typename Asked>
bool is_in(const Situation& now, std::uint8_t joint, bool is_scope, Asked asked) noexcept {
  const auto all = instruments::catalogue();
  for (std::size_t h = 0; h < procedure::kHands; ++h) {
    const instruments::InstrumentIndex held = now.hands[h].instrument;
    if (held >= all.size() || all[held].optic.has_value() != is_scope) continue;
    if (now.scope.is_in_joint[h] && now.scope.joint[h] == joint && asked(now.scope.portal[h])) {
      return true;
    }
  }
  return false;
}

constexpr std::uint32_t bits_of(std::initializer_list<int> numbers) noexcept {
  std::uint32_t bits = 0;
  for (const int number : numbers) bits |= 1U << number;
  return bits;
}

template <int... kNumbers>
bool has_seen(const Situation& now) noexcept {
  constexpr std::uint32_t kBits = bits_of({kNumbers...});
  return (now.scope.points_seen & kBits) == kBits;
}

bool is_pulled(const Situation& now) noexcept {
  return now.wrist.traction_n >= kLeastTractionN && now.wrist.traction_n <= kMostTractionN;
}
/// By whichever portal was chosen: the page says where that one lies.
bool is_scope_in(const Situation& now) noexcept {
  return is_in(now, kRadiocarpal, true, [](std::uint8_t) { return true; });
}
/// Where portals are made: by the one that was made first, what works beside it by another.
bool is_scope_in_first(const Situation& now) noexcept {
  return is_in(now, kRadiocarpal, true, [](std::uint8_t by) { return by == kPortal34; });
}
bool is_probe_in_second(const Situation& now) noexcept {
  return is_in(now, kRadiocarpal, false, [](std::uint8_t by) { return by != kPortal34; });
}
/// Something works beside the scope.
bool is_tool_in(const Situation& now) noexcept {
  return is_in(now, kRadiocarpal, false, [](std::uint8_t) { return true; });
}
bool is_scope_ulnar(const Situation& now) noexcept {
  return is_in(now, kRadiocarpal, true, [&now](std::uint8_t by) {
    for (std::size_t h = 0; h < procedure::kHands; ++h) {
      if (now.scope.portal[h] == by && is_ulnar(now.scope.portal_number[h])) return true;
    }
    return false;
  });
}
bool is_scope_midcarpal(const Situation& now) noexcept {
  return is_in(now, kMidcarpal, true, [](std::uint8_t) { return true; });
}
bool has_probed_disc(const Situation& now) noexcept {
  constexpr std::uint32_t kDisc = bits_of({11});
  return has_seen<11>(now) && (now.scope.points_probed & kDisc) != 0;
}
bool has_seen_a_ligament(const Situation& now) noexcept {
  constexpr std::uint32_t kVolar = bits_of({4, 5, 6, 9});
  return (now.scope.points_seen & kVolar) != 0;
}
bool has_seen_ulnar(const Situation& now) noexcept {
  constexpr std::uint32_t kUlnar = bits_of({14, 15, 17});
  return has_seen<13>(now) && (now.scope.points_seen & kUlnar) != 0;
}
bool has_answered_all(const Situation& now) noexcept { return now.scope.unanswered == 0; }
template <std::uint8_t kPlaces>
bool has_held(const Situation& now) noexcept {
  return now.scope.drill.held >= kPlaces;
}
bool has_looked_round(const Situation& now) noexcept { return now.scope.drill.is_round_done; }
bool has_touched_all(const Situation& now) noexcept { return now.scope.drill.are_touches_done; }
bool has_followed_line(const Situation& now) noexcept { return now.scope.drill.is_line_done; }
bool has_seen_loose(const Situation& now) noexcept { return now.scope.loose.seen > 0; }
bool has_caught_one(const Situation& now) noexcept { return now.scope.loose.catches > 0; }
bool has_brought_one_out(const Situation& now) noexcept { return now.scope.loose.out > 0; }
bool has_looked_again(const Situation& now) noexcept {
  constexpr int kPlaces = 5;
  return now.scope.loose.out > 0 && std::popcount(now.scope.loose.seen_since) >= kPlaces;
}
bool has_seen_patch(const Situation& now) noexcept { return now.scope.shaving.patches_seen != 0; }
bool has_cut_ill(const Situation& now) noexcept { return now.scope.shaving.ill_removed > 0; }
bool has_looked_at_cut(const Situation& now) noexcept {
  constexpr int kPlaces = 5;
  return has_cut_ill(now) && std::popcount(now.scope.shaving.seen_since) >= kPlaces;
}
constexpr unsigned bit_of(cases::ScrewSite site) noexcept {
  return 1U << static_cast<unsigned>(site);
}
constexpr unsigned kMidcarpalSites =
    bit_of(cases::ScrewSite::Scaphocapitate) | bit_of(cases::ScrewSite::Stt);
bool has_seen_screw_entry(const Situation& now) noexcept {
  return (now.scope.screw.seen & bit_of(cases::ScrewSite::Proximal)) != 0;
}
bool has_probed_screw_entry(const Situation& now) noexcept {
  return (now.scope.screw.probed & bit_of(cases::ScrewSite::Proximal)) != 0;
}
bool has_seen_screw_midcarpal(const Situation& now) noexcept {
  return (now.scope.screw.seen & kMidcarpalSites) == kMidcarpalSites;
}
bool has_probed_screw_midcarpal(const Situation& now) noexcept {
  return (now.scope.screw.probed & kMidcarpalSites) != 0;
}
bool is_finishing(const Situation& now) noexcept { return now.is_finishing; }

}  // namespace

std::span<const NamedPredicate> named_predicates() {
  static constexpr std::array kPredicates{
      NamedPredicate{"is_pulled", is_pulled},
      NamedPredicate{"is_scope_in", is_scope_in},
      NamedPredicate{"is_scope_in_first", is_scope_in_first},
      NamedPredicate{"is_probe_in", is_tool_in},
      NamedPredicate{"is_probe_in_second", is_probe_in_second},
      NamedPredicate{"is_grasper_in", is_tool_in},
      NamedPredicate{"is_shaver_in", is_tool_in},
      NamedPredicate{"is_tool_in", is_tool_in},
      NamedPredicate{"has_seen_radial", has_seen<1, 2, 3>},
      NamedPredicate{"has_seen_scapholunate", has_seen<7>},
      NamedPredicate{"has_seen_lunate", has_seen<8, 10>},
      NamedPredicate{"has_probed_disc", has_probed_disc},
      NamedPredicate{"has_seen_a_ligament", has_seen_a_ligament},
      NamedPredicate{"is_scope_ulnar", is_scope_ulnar},
      NamedPredicate{"has_seen_ulnar", has_seen_ulnar},
      NamedPredicate{"is_scope_midcarpal", is_scope_midcarpal},
      NamedPredicate{"has_seen_radiocarpal", has_seen<2, 3, 7, 8>},
      NamedPredicate{"has_answered_all", has_answered_all},
      NamedPredicate{"has_seen_midcarpal_rows", has_seen<20, 23>},
      NamedPredicate{"has_seen_distal_row", has_seen<18, 21, 24>},
      NamedPredicate{"has_held_1", has_held<1>},
      NamedPredicate{"has_held_2", has_held<2>},
      NamedPredicate{"has_held_3", has_held<3>},
      NamedPredicate{"has_looked_round", has_looked_round},
      NamedPredicate{"has_touched_all", has_touched_all},
      NamedPredicate{"has_followed_line", has_followed_line},
      NamedPredicate{"has_seen_loose", has_seen_loose},
      NamedPredicate{"has_caught_one", has_caught_one},
      NamedPredicate{"has_brought_one_out", has_brought_one_out},
      NamedPredicate{"has_looked_again", has_looked_again},
      NamedPredicate{"has_seen_patch", has_seen_patch},
      NamedPredicate{"has_cut_ill", has_cut_ill},
      NamedPredicate{"has_looked_at_cut", has_looked_at_cut},
      NamedPredicate{"has_seen_screw_entry", has_seen_screw_entry},
      NamedPredicate{"has_probed_screw_entry", has_probed_screw_entry},
      NamedPredicate{"has_seen_screw_midcarpal", has_seen_screw_midcarpal},
      NamedPredicate{"has_probed_screw_midcarpal", has_probed_screw_midcarpal},
      NamedPredicate{"is_finishing", is_finishing}};
  return kPredicates;
}

procedure::Opening opening(const cases::CaseData& data, std::string_view name) {
  const std::string who(name);
  if (cases::find_bone(data, BoneId::Radius) == nullptr) {
    throw InvalidInput(who + ": the case has no radius");
  }
  if (data.arthroscopy == nullptr) {
    throw InvalidInput(who +
                       ": the case has no soft tissue; make it with 'carpus soft-tissue' "
                       "and open the case again");
  }
  const std::vector<cases::Portal>& portals = data.arthroscopy->portals;
  if (portals.size() <= kPortal45 || data.arthroscopy->joints.front().id != kFirstJoint ||
      portals[kPortal34].id != kFirst || portals[kPortal45].id != kSecond) {
    std::string why;
    for (const std::string& each : data.arthroscopy->problems) why += "; " + each;
    throw InvalidInput(who + ": the 3-4 and 4-5 portals cannot be used" + why);
  }
  procedure::Opening opening;
  opening.shaft_in_target = -portals[kPortal34].inwards;
  opening.tip_in_target = portals[kPortal34].skin + opening.shaft_in_target * kWaitsMm;
  return opening;
}

void refuse_without_places(const cases::CaseData& data,
                           const procedure::ScopeDrill& drill,
                           std::string_view name) {
  const std::vector<cases::TourPoint>& points = data.arthroscopy->points;
  for (const auto* places : {&drill.hold, &drill.touch, &drill.line}) {
    for (const std::uint8_t number : *places) {
      const bool is_there = std::any_of(points.begin(), points.end(),
                                        [&](const auto& point) { return point.number == number; });
      if (is_there) continue;
      throw InvalidInput(std::string(name) + ": this wrist lacks place " + std::to_string(number) +
                         " of the tour, which an exercise goes to; choose another case");
    }
  }
}

}  // namespace carpus::procedures::arthroscopy

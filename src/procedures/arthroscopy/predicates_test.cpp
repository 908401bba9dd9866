// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "instruments/instrument.hpp"
#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::arthroscopy {
namespace {

bool holds(std::string_view name, const procedure::Situation& now) {
  for (const procedure::NamedPredicate& each : named_predicates()) {
    if (each.name == name) return each.predicate(now);
  }
  ADD_FAILURE() << "no predicate " << name;
  return false;
}

/// What is held, in a joint by a portal.
procedure::Situation in(const char* instrument, std::uint8_t joint, std::uint8_t portal) {
  procedure::Situation now;
  now.hands[0].instrument = *instruments::instrument_of(instrument);
  now.scope.is_in_joint[0] = true;
  now.scope.joint[0] = joint;
  now.scope.portal[0] = portal;
  return now;
}

TEST(ArthroscopyPredicates, AScopeIsInByWhicheverPortalOfTheJointWasChosen) {
  for (const std::uint8_t portal : std::initializer_list<std::uint8_t>{0, 2, 7}) {
    EXPECT_TRUE(holds("is_scope_in", in("arthroscope_1_9_30", 0, portal))) << int{portal};
    EXPECT_TRUE(holds("is_probe_in", in("hook_probe", 0, portal))) << int{portal};
  }
  EXPECT_FALSE(holds("is_scope_in", in("arthroscope_1_9_30", 1, 3))) << "that is the other joint";
  EXPECT_FALSE(holds("is_scope_in", in("hook_probe", 0, 0)));
  EXPECT_FALSE(holds("is_scope_in", {}));
}

TEST(ArthroscopyPredicates, WherePortalsAreMadeEachIsForWhatItWasMadeFor) {
  EXPECT_TRUE(holds("is_scope_in_first", in("arthroscope_1_9_30", 0, 0)));
  EXPECT_FALSE(holds("is_scope_in_first", in("arthroscope_1_9_30", 0, 1)));
  EXPECT_TRUE(holds("is_probe_in_second", in("hook_probe", 0, 1)));
  EXPECT_FALSE(holds("is_probe_in_second", in("hook_probe", 0, 0)));
}

}  // namespace
}  // namespace carpus::procedures::arthroscopy

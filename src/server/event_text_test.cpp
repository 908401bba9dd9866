// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/event_text.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "anatomy/bone_id.hpp"

namespace carpus::server {
namespace {

using simulation::Event;
using simulation::EventKind;

TEST(EventText, EveryKindHasItsOwnNameAndASentence) {
  std::set<std::string> kinds;
  constexpr int kLast = static_cast<int>(EventKind::Slipped);
  for (int i = 1; i <= kLast; ++i) {
    const protocol::LoggedEvent event = describe(Event{static_cast<EventKind>(i), 1, 2.0, 3});
    EXPECT_FALSE(event.text.empty()) << event.kind;
    EXPECT_NE(event.kind, "none") << i;
    kinds.insert(event.kind);
  }
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(kLast));
}

TEST(EventText, NamesBonesAsPeopleDo) {
  const Event slipped{EventKind::Slipped, static_cast<int>(BoneId::Metacarpal1), 0.0, 7};
  EXPECT_EQ(describe(slipped).kind, "slipped");
  EXPECT_NE(describe(slipped).text.find("along the first metacarpal"), std::string::npos);
  const Event entered{EventKind::WireEngaged, kScaphoidDistalLabel, 0.0, 7};
  EXPECT_EQ(describe(entered).text, "Wire entered the distal part of the scaphoid");
}

}  // namespace
}  // namespace carpus::server

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/find_structure.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "anatomy/structure_table.hpp"

namespace carpus::cases {
namespace {

std::vector<Structure> with(std::initializer_list<const char*> ids) {
  std::vector<Structure> made;
  for (const char* id : ids) {
    made.emplace_back();
    made.back().id = id;
  }
  return made;
}

TEST(FindStructure, FindsByIdAlone) {
  const std::vector<Structure> two = with({"fcu", "ulnar_nerve"});
  EXPECT_EQ(find_structure(two, "ulnar_nerve"), &two[1]);
  EXPECT_EQ(find_structure(two, "ulnar"), nullptr);
}

TEST(FindStructure, NamesWhatIsLackingAsAPersonSaysIt) {
  const std::vector<Structure> one = with({"ulnar_nerve"});
  EXPECT_EQ(lacking(one, {"ulnar_nerve"}), "");
  EXPECT_EQ(lacking(one, {"ulnar_artery", "ulnar_nerve", "fcu"}),
            "ulnar artery, flexor carpi ulnaris");
}

TEST(FindStructure, ACaseThatHasTheWholeTableLacksNothing) {
  std::vector<Structure> all;
  for (const auto& tabled : anatomy::StructureTable::generic().structures) {
    all.emplace_back();
    all.back().id = tabled.id;
  }
  EXPECT_EQ(lacking(all), "");
  EXPECT_LE(all.size(), kMaxStructures);
  all.pop_back();
  EXPECT_NE(lacking(all), "");
}

}  // namespace
}  // namespace carpus::cases

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopy_from_the_skin/declared.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "procedures/arthroscopic_portal_making/declared.hpp"
#include "procedures/arthroscopy/conduct.hpp"
#include "procedures/diagnostic_arthroscopy/declared.hpp"

namespace carpus::procedures::arthroscopy_from_the_skin {
namespace {

using Json = nlohmann::ordered_json;
using procedure::NamedPredicate;

/// Each entry over that of the same id, where another procedure declares one.
Json completed(const Json& own, std::initializer_list<const Json*> others) {
  Json all = Json::array();
  for (const Json& entry : own) {
    Json whole = Json::object();
    for (const Json* other : others) {
      for (const Json& one : *other) {
        if (one.at("id") == entry.at("id")) whole = one;
      }
    }
    whole.merge_patch(entry);
    all.push_back(std::move(whole));
  }
  return all;
}

std::string merged() {
  const Json making = Json::parse(arthroscopic_portal_making::json());
  const Json tour = Json::parse(diagnostic_arthroscopy::json());
  Json own = Json::parse(json());
  for (const char* list : {"steps", "score", "safety"}) {
    own[list] = completed(own.at(list), {&tour.at(list), &making.at(list)});
  }
  Json text = making;
  text.merge_patch(own);
  return text.dump();
}

/// In the scope's picture, in the joint, while the skin was whole.
bool has_seen_needle_2(const procedure::Situation& now) noexcept {
  return now.making.portal[1].needle_seen_ticks >= procedure::kNeedleSeenTicks;
}

/// Those of making portals, and of looking round those that these have not.
std::vector<NamedPredicate> named_predicates() {
  const auto making = arthroscopic_portal_making::named_predicates();
  std::vector<NamedPredicate> all(making.begin(), making.end());
  all.push_back({"has_seen_needle_2", has_seen_needle_2});
  for (const NamedPredicate& other : arthroscopy::named_predicates()) {
    const bool is_there = std::any_of(
        all.begin(), all.end(), [&](const NamedPredicate& one) { return one.name == other.name; });
    if (!is_there) all.push_back(other);
  }
  return all;
}

procedure::Opening opening(const cases::CaseData& data) {
  return arthroscopic_portal_making::opened(declared(), data);
}

}  // namespace

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = [] {
    procedure::Procedure read = procedure::read_procedure(
        merged(), "arthroscopy_from_the_skin/procedure.json", named_predicates());
    read.opening = opening;
    read.score = score;
    return read;
  }();
  return kDeclared;
}

}  // namespace carpus::procedures::arthroscopy_from_the_skin

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopic_portal_making_harder/declared.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "procedures/arthroscopic_portal_making/declared.hpp"

namespace carpus::procedures::arthroscopic_portal_making_harder {
namespace {

std::string merged() {
  auto text = nlohmann::ordered_json::parse(arthroscopic_portal_making::json());
  text.merge_patch(nlohmann::ordered_json::parse(json()));
  return text.dump();
}

procedure::Opening opening(const cases::CaseData& data) {
  return arthroscopic_portal_making::opened(declared(), data);
}

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  return arthroscopic_portal_making::scored(declared(), data, record);
}

}  // namespace

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = [] {
    procedure::Procedure read =
        procedure::read_procedure(merged(), "arthroscopic_portal_making_harder/procedure.json",
                                  arthroscopic_portal_making::named_predicates());
    read.opening = opening;
    read.score = score;
    return read;
  }();
  return kDeclared;
}

}  // namespace carpus::procedures::arthroscopic_portal_making_harder

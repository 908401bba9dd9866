// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopic_loose_body_removal/declared.hpp"

#include "procedure/grading.hpp"
#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::arthroscopic_loose_body_removal {
namespace {

procedure::Opening opening(const cases::CaseData& data) {
  return arthroscopy::opening(data, "removal of loose bodies");
}

}  // namespace

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = [] {
    procedure::Procedure read = procedure::read_procedure(
        json(), "arthroscopic_loose_body_removal/procedure.json", arthroscopy::named_predicates());
    read.opening = opening;
    read.score = score;
    return read;
  }();
  return kDeclared;
}

}  // namespace carpus::procedures::arthroscopic_loose_body_removal

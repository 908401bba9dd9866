// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopic_basics/declared.hpp"

#include "procedure/grading.hpp"
#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::arthroscopic_basics {
namespace {

procedure::Opening opening(const cases::CaseData& data) { return opened(declared(), data); }

}  // namespace

procedure::Opening opened(const procedure::Procedure& graded, const cases::CaseData& data) {
  procedure::Opening opening = arthroscopy::opening(data, "basic skills");
  arthroscopy::refuse_without_places(data, *graded.drill, "basic skills");
  return opening;
}

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = [] {
    procedure::Procedure read = procedure::read_procedure(
        json(), "arthroscopic_basics/procedure.json", arthroscopy::named_predicates());
    read.opening = opening;
    read.score = score;
    return read;
  }();
  return kDeclared;
}

}  // namespace carpus::procedures::arthroscopic_basics

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/diagnostic_arthroscopy/declared.hpp"

#include "procedure/grading.hpp"
#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::diagnostic_arthroscopy {
namespace {

procedure::Opening opening(const cases::CaseData& data) {
  return arthroscopy::opening(data, "diagnostic arthroscopy");
}

}  // namespace

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = [] {
    procedure::Procedure read = procedure::read_procedure(
        json(), "diagnostic_arthroscopy/procedure.json", arthroscopy::named_predicates());
    read.opening = opening;
    read.score = score;
    return read;
  }();
  return kDeclared;
}

}  // namespace carpus::procedures::diagnostic_arthroscopy

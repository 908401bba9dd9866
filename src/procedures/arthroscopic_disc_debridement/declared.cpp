// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopic_disc_debridement/declared.hpp"

#include "procedures/arthroscopy/shaving.hpp"

namespace carpus::procedures::arthroscopic_disc_debridement {

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = [] {
    procedure::Procedure read = procedure::read_procedure(
        json(), "arthroscopic_disc_debridement/procedure.json", arthroscopy::named_predicates());
    read.opening = [](const cases::CaseData& data) {
      return arthroscopy::open_to_shave(data, *declared().shaving, "debridement of the disc");
    };
    read.score = [](const cases::CaseData& data, const procedure::OperationRecord& record) {
      return arthroscopy::score_shaving(data, declared(), record);
    };
    return read;
  }();
  return kDeclared;
}

}  // namespace carpus::procedures::arthroscopic_disc_debridement

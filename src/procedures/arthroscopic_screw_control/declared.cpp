// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopic_screw_control/declared.hpp"

#include <string>

#include "arthroscopy/make_screw.hpp"
#include "core/error.hpp"
#include "procedure/grading.hpp"
#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::arthroscopic_screw_control {
namespace {

constexpr const char* kName = "arthroscopic screw control";

/// Refuses where no screw can be laid: whether one can hangs on the bone, not on the seed.
procedure::Opening opening(const cases::CaseData& data) {
  procedure::Opening opening = arthroscopy::opening(data, kName);
  if (!carpus::arthroscopy::make_screw(data, *data.arthroscopy, 0).screw) {
    throw InvalidInput(std::string(kName) +
                       ": no screw can lie well in this scaphoid as it was scanned (its pieces lie "
                       "apart, or the midcarpal joint cannot be looked into); choose another case");
  }
  return opening;
}

}  // namespace

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = [] {
    procedure::Procedure read = procedure::read_procedure(
        json(), "arthroscopic_screw_control/procedure.json", arthroscopy::named_predicates());
    read.opening = opening;
    read.score = score;
    return read;
  }();
  return kDeclared;
}

}  // namespace carpus::procedures::arthroscopic_screw_control

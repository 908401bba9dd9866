// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopic_loose_body_removal/declared.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "procedure/grading.hpp"
#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::arthroscopic_loose_body_removal {
namespace {

constexpr std::string_view kName = "removal of loose bodies";

procedure::Opening opening(const cases::CaseData& data) {
  procedure::Opening opening = arthroscopy::opening(data, kName);
  const auto& removal = *declared().removal;
  const auto& points = data.arthroscopy->points;
  const auto there = std::count_if(points.begin(), points.end(), [&](const auto& point) {
    return std::find(removal.places.begin(), removal.places.end(), point.number) !=
           removal.places.end();
  });
  if (there < removal.bodies[1]) {
    throw InvalidInput(std::string(kName) +
                       ": this wrist has too few of the places by which bodies may lie; choose "
                       "another case");
  }
  return opening;
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

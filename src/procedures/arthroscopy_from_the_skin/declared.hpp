// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An arthroscopy from closed skin on: two portals are made, and by these and no other one looks
// round in the joint [clinical: B7, B8]. Steps and rules that the making of portals and the tour
// declare are theirs; procedure.json names them and says what differs.
#pragma once

#include <string_view>

#include "procedure/procedure.hpp"

namespace carpus::procedures::arthroscopy_from_the_skin {

/// The text of procedure.json, built in by CMakeLists.txt.
[[nodiscard]] std::string_view json();

/// Read once, on the first call. @throws InvalidInput  when procedure.json is wrong.
[[nodiscard]] const procedure::Procedure& declared();

/// By the rules in procedure.json.
[[nodiscard]] procedure::ScoreReport score(const cases::CaseData& data,
                                           const procedure::OperationRecord& record);

}  // namespace carpus::procedures::arthroscopy_from_the_skin

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The scan of a case, as its folder has it (docs/case_format.md), for who looks at it: CT, labels,
// surfaces and what is known of the bones.
#pragma once

#include <string_view>

#include "server/case_shelf.hpp"
#include "server/http_message.hpp"
#include "server/truth_gate.hpp"

namespace carpus::server {

/// @param rest  behind "/api/cases/": "<id>/scan/<file>"
[[nodiscard]] bool is_scan_path(std::string_view rest) noexcept;

/// Reads from the disk. @param gate  null: nothing is ever held back.
[[nodiscard]] HttpResponse answer_scan(const CaseShelf& shelf,
                                       const TruthGate* gate,
                                       std::string_view rest);

}  // namespace carpus::server

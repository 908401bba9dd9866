// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What of a joint's cartilage an arthroscopy truly showed, to be painted on the bones.
#pragma once

#include "cases/case_data.hpp"
#include "procedure/operation_record.hpp"
#include "protocol/bodies.hpp"

namespace carpus::server {

/// Of at most 8000 facets of a bone, twice what the largest has. About a second.
/// @param data  with an arthroscopic map.
[[nodiscard]] protocol::SeenCartilage seen_cartilage(const cases::CaseData& data,
                                                     const procedure::ScopeRecord& scope);

}  // namespace carpus::server

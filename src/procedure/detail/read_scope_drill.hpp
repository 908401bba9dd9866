// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A procedure's exercises with a scope, from its JSON (docs/how_to_add_a_procedure.md).
#pragma once

#include "core/json_fields.hpp"
#include "procedure/scope_drill.hpp"

namespace carpus::procedure::detail {

/// @throws InvalidInput naming file, place and field.
[[nodiscard]] ScopeDrill read_scope_drill(JsonFields& fields);

}  // namespace carpus::procedure::detail

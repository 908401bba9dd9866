// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/json_fields.hpp"
#include "procedure/fluid_use.hpp"

namespace carpus::procedure::detail {

/// @throws InvalidInput naming the field.
[[nodiscard]] FluidUse read_fluid_use(JsonFields& fields);

}  // namespace carpus::procedure::detail

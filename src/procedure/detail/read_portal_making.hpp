// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/json_fields.hpp"
#include "procedure/portal_making.hpp"

namespace carpus::procedure::detail {

/// @throws InvalidInput naming the field.
[[nodiscard]] PortalMaking read_portal_making(JsonFields& fields);

}  // namespace carpus::procedure::detail

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/detail/read_fluid_use.hpp"

namespace carpus::procedure::detail {

FluidUse read_fluid_use(JsonFields& fields) {
  FluidUse use;
  use.has_tourniquet = fields.boolean_or("tourniquet", true);
  (void)fields.text("mark");
  fields.refuse_unknown_fields();
  return use;
}

}  // namespace carpus::procedure::detail

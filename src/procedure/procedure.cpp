// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/procedure.hpp"

namespace carpus::procedure {

const Procedure* ProcedureList::find(std::string_view id) const noexcept {
  for (const Procedure* each : all_) {
    if (each->id == id) return each;
  }
  return nullptr;
}

}  // namespace carpus::procedure

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/procedure.hpp"

#include <cstddef>
#include <utility>

#include "core/error.hpp"

namespace carpus::procedure {

ProcedureList::ProcedureList(std::vector<const Procedure*> all) : all_(std::move(all)) {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (all_[i]->id == all_[j]->id) {
        throw InvalidInput("procedures: two have the id '" + all_[i]->id +
                           "'; give each the name of its folder");
      }
    }
  }
}

const Procedure* ProcedureList::find(std::string_view id) const noexcept {
  for (const Procedure* each : all_) {
    if (each->id == id) return each;
  }
  return nullptr;
}

}  // namespace carpus::procedure

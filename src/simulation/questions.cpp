// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/questions.hpp"

#include "arthroscopy/screw_table.hpp"

namespace carpus::simulation {

const arthroscopy::PathologyTable* questions_of(const procedure::Procedure& procedure) {
  if (procedure.examines) return &arthroscopy::PathologyTable::generic();
  if (procedure.controls_screw) return &arthroscopy::ScrewTable::generic().questions;
  return nullptr;
}

}  // namespace carpus::simulation

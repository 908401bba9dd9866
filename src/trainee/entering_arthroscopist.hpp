// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A scripted operator of an arthroscopy from closed skin on: makes a portal, looks in by it and
// makes the second one in the scope's sight, or both from outside as its skill says; then looks
// round by these, wherever they came to lie.
#pragma once

#include <memory>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"
#include "trainee/arthroscopist.hpp"
#include "trainee/portal_maker.hpp"
#include "trainee/skill.hpp"

namespace carpus::trainee {

class EnteringArthroscopist {
 public:
  /// Whether the procedure is one that this operator knows: portals are made, and a scope is there
  /// to go in by them.
  [[nodiscard]] static bool knows(const procedure::Procedure& procedure);

  /// @throws InvalidInput  when it cannot be done on this case (the procedure's opening).
  EnteringArthroscopist(const cases::CaseData& data,
                        const procedure::Procedure& procedure,
                        Skill skill,
                        std::uint64_t seed);

  /// The input for the next tick, from the state that the last one left.
  [[nodiscard]] simulation::Input next(const simulation::Snapshot& now);

 private:
  enum class Stage : std::uint8_t { Make, DrawOut, Watch, Look };

  [[nodiscard]] std::vector<cases::TourPoint> where_needle_comes_in(
      const simulation::Snapshot& now) const;
  simulation::Input make(const simulation::Snapshot& now);
  simulation::Input draw_out(const simulation::Snapshot& now);
  simulation::Input look(const simulation::Snapshot& now);

  const cases::CaseData& data_;
  procedure::Procedure look_;  ///< with scope and probe alone
  Skill skill_;
  std::uint64_t seed_;
  ScriptedPortalMaker maker_;
  Stage stage_ = Stage::Make;
  simulation::Input last_;
  Tick drawn_ = 0;
  cases::ArthroscopicMap map_;  ///< with the portals as they were made, and what they show
  std::unique_ptr<ScriptedArthroscopist> looker_;
};

}  // namespace carpus::trainee

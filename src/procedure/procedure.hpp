// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a procedure is: declared data and the few functions that need code. Nothing above this
// module names one; src/procedures/ holds each in a folder of its own
// (docs/how_to_add_a_procedure.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "cases/case_data.hpp"
#include "geometry/vec3.hpp"
#include "instruments/instrument.hpp"
#include "procedure/operation_record.hpp"
#include "procedure/score.hpp"
#include "procedure/score_rules.hpp"
#include "procedure/situation.hpp"

namespace carpus::procedure {

using Predicate = bool (*)(const Situation&) noexcept;

/// One step. Steps guide, they never forbid; what was skipped shows in the score.
struct Step {
  std::string id;                    ///< snake_case, stable: "survey"
  std::string title;                 ///< "Survey"
  std::string instruction;           ///< one sentence: what to do next
  std::vector<std::string> actions;  ///< ids of the actions whose keys the page names with it
  Predicate is_done = nullptr;
  /// Once done it stays done until this holds; nullptr: for good.
  Predicate is_lost = nullptr;
  /// A step that is still current when this one is done cannot be made up for: it is passed over.
  bool passes_over_earlier = false;
  /// What it is done with: shown on the tray, taken by scripts; kNoInstrument: nothing new.
  instruments::InstrumentIndex instrument = instruments::kNoInstrument;
};

/// A view of the C-arm that the procedure asks for.
struct NamedView {
  std::string id;  ///< "pa"
  std::string label;
  double rotation_deg = 0.0;  ///< from the forearm as it is held
  double tilt_deg = 0.0;
  /// How the hand is held for it; none: as it is.
  std::optional<double> flexion_deg = std::nullopt;
  std::optional<double> radial_deviation_deg = std::nullopt;
};

/// How the operation begins on a case: computed before it, may use trigonometry. The hand waits in
/// frame Bone of the target (as scanned; its first part), so that nothing here needs to know where
/// the wrist's pose takes that bone.
struct Opening {
  WristPose wrist;  ///< how the hand is posed for the bone to be reached
  /// How it lies before the operator poses it; none: so already.
  std::optional<WristPose> at_first = std::nullopt;
  Vec3 tip_in_target;             ///< where the first hand waits, outside all tissue [mm]
  Vec3 shaft_in_target{0, 0, 1};  ///< unit, towards the hand
  Aim aim;                        ///< what the operation is after on this case
};

struct Procedure {
  std::string id;       ///< "dorsal_scaphoid_fixation": protocol, recordings, records, --procedure
  std::string title;    ///< "Dorsal percutaneous scaphoid fixation"
  std::string summary;  ///< two sentences for the start dialog
  BoneId target = BoneId::Scaphoid;
  std::vector<BoneId> allowed;                     ///< bones besides the target that may be entered
  std::vector<instruments::InstrumentIndex> tray;  ///< what may be taken, in order; the first is in
                                                   ///< the first hand at the beginning
  std::vector<Step> steps;                         ///< at most kMaxSteps
  std::vector<NamedView> views;
  ScoreRules rules;
  DeclineRules decline;
  /// @throws InvalidInput when it cannot be done on this case, saying why.
  Opening (*opening)(const cases::CaseData& data) = nullptr;
  ScoreReport (*score)(const cases::CaseData& data, const OperationRecord& record) = nullptr;
};

/// Procedures that a host offers. They must outlive it.
class ProcedureList {
 public:
  ProcedureList() = default;
  /// @throws InvalidInput when two have the same id: records could not tell them apart.
  explicit ProcedureList(std::vector<const Procedure*> all);
  [[nodiscard]] std::span<const Procedure* const> all() const noexcept { return all_; }
  /// nullptr when it is not offered.
  [[nodiscard]] const Procedure* find(std::string_view id) const noexcept;

 private:
  std::vector<const Procedure*> all_;
};

/// Names by which data refer to the code of one procedure.
struct NamedPredicate {
  std::string_view name;
  Predicate predicate;
};

/// Reads steps, views, tray, texts from a procedure.json (docs/how_to_add_a_procedure.md); the
/// predicates of steps are found by name, `opening` and `score` are set by the caller.
/// @param file  names it in errors.
/// @throws InvalidInput "dorsal.json: steps[3]: done: no predicate 'driven' among those given: …".
[[nodiscard]] Procedure read_procedure(std::string_view json,
                                       std::string_view file,
                                       std::span<const NamedPredicate> predicates);

}  // namespace carpus::procedure

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The truth about pictures: what bone and metal were on one that was taken, and which views would
// have shown what is wrong with the screw and the fracture at the end.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "anatomy/reduction.hpp"
#include "cases/case_data.hpp"
#include "protocol/bodies.hpp"
#include "server/exercise.hpp"
#include "simulation/snapshot.hpp"
#include "view_trainer/seen_screw.hpp"

namespace carpus::server {

class ViewDebrief {
 public:
  /// About a second. @param data  must outlive it. @throws InvalidInput where it has no scaphoid.
  explicit ViewDebrief(const cases::CaseData& data);
  ~ViewDebrief();

  /// The screw that lies in the scaphoid, if one does: in the frame of the scaphoid's first piece,
  /// where that lies then.
  [[nodiscard]] static std::optional<view_trainer::PlacedScrew> screw_in(
      const cases::CaseData& data,
      const simulation::Snapshot& now);

  /// Of a picture that was taken.
  [[nodiscard]] protocol::PictureTruth truth_of(const TakenShot& shot);

  /// @param end  state after the last tick. @param taken  pictures; only those on which the screw
  ///     lies as it does at the end are told of, the last first where they are too many.
  [[nodiscard]] protocol::ViewDebrief debrief(const simulation::Snapshot& end,
                                              std::span<const TakenShot> taken);

 private:
  struct Lying;
  /// The scaphoid as its pieces lie at a moment: led, drawn together or as scanned.
  const Lying& lying_at(const simulation::Snapshot& now);

  const cases::CaseData& data_;
  std::optional<anatomy::Reduction> faces_;    ///< of a scaphoid in two pieces
  std::vector<std::unique_ptr<Lying>> lying_;  ///< the newest last
};

}  // namespace carpus::server

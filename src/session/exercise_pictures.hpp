// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluoroscopy of an exercise: bones where they are, holes that were drilled, metal as it lies. Off
// the 1 kHz thread; one thread at a time.
#pragma once

#include <optional>
#include <vector>

#include "cases/case_data.hpp"
#include "fluoroscopy/composed_renderer.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// Pixels a side of a live picture while something moves.
inline constexpr int kMovingPixels = 256;

/// What is to be seen.
struct PictureView {
  BoneId target = BoneId::Scaphoid;  ///< what the beam is centred on, where it is now
  double rotation_deg = 0.0;         ///< of the C-arm in the room, from the forearm as scanned
  double tilt_deg = 0.0;
};

/// The C-arm of a view, centred on the target where it lies.
/// @throws InvalidInput for angles that no C-arm can take.
[[nodiscard]] fluoroscopy::CArmPose beam_of(const cases::CaseData& data,
                                            const PictureView& view,
                                            const simulation::Snapshot& now,
                                            const fluoroscopy::CArmGeometry& geometry = {});

class ExercisePictures {
 public:
  /// Takes the scan apart: about half a second. @param data  as scanned; must outlive this.
  /// @throws InvalidInput where CT and labels do not fit.
  explicit ExercisePictures(const cases::CaseData& data);

  /// The state decides, not what was taken before.
  /// @throws InvalidInput for angles that no C-arm can take.
  [[nodiscard]] fluoroscopy::Image take(const PictureView& view, const simulation::Snapshot& now);

  /// One pulse of live pictures: coarse while bones or C-arm move (since the last one), full when
  /// they rest; with the noise of a pulse.
  /// @throws InvalidInput as `take`.
  [[nodiscard]] fluoroscopy::Image take_live(const PictureView& view,
                                             const simulation::Snapshot& now);

  /// The last pulse of a live look in full: its noise is a pulse's, for no more was paid.
  /// @throws InvalidInput as `take`.
  [[nodiscard]] fluoroscopy::Image take_held(const PictureView& view,
                                             const simulation::Snapshot& now);

 private:
  [[nodiscard]] fluoroscopy::BeamScene scene_of(const PictureView& view,
                                                const simulation::Snapshot& now,
                                                const fluoroscopy::CArmGeometry& geometry) const;
  void take_in_holes(const simulation::Snapshot& now);

  const cases::CaseData& data_;
  fluoroscopy::ComposedRenderer renderer_;
  std::vector<std::vector<simulation::TrackView>> holes_;  ///< taken in, by body
  /// Where C-arm and bodies were in the last live picture.
  std::optional<fluoroscopy::CArmPose> live_beam_;
  std::vector<Pose<frame::Patient, frame::Bone>> live_poses_;
};

}  // namespace carpus::session

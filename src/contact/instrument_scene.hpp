// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// All instruments against all bones, each tick: who touches whom, on the true surfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/instrument_contact.hpp"
#include "fields/contact_field.hpp"
#include "fields/cut_field.hpp"
#include "geometry/instrument_shape.hpp"
#include "geometry/pose.hpp"

namespace carpus::contact {

struct InstrumentSceneOptions {
  /// Gaps up to this are told as Near; pairs farther apart are Far [mm].
  double within_mm = 0.0;
  /// A pair that is looked at is searched this much farther [mm], so that it can be left alone
  /// until it has moved by about as much.
  double look_ahead_mm = 1.0;
};

/// How the pairs of all updates were decided.
struct InstrumentSceneCounts {
  std::uint64_t pairs = 0;
  std::uint64_t left_alone = 0;  ///< Far: moved too little since they were last looked at
  std::uint64_t by_bounds = 0;   ///< Far: ball or box of the bone is far from the shaft
  std::uint64_t by_field = 0;    ///< the field was walked
  std::uint64_t not_known = 0;   ///< poses that are not finite
};

struct InstrumentBonePair {
  std::uint32_t instrument = 0;
  std::uint32_t bone = 0;
  constexpr bool operator==(const InstrumentBonePair&) const = default;
};

class InstrumentScene {
 public:
  /// @param bones  fields in the bones' own frames; they must outlive the scene.
  /// @throws InvalidInput if there are no bones or instruments, an option is negative or not
  ///     finite, or a shape is too thick for a field (greatest_gap_mm() below within_mm).
  InstrumentScene(std::span<const fields::ContactField> bones,
                  std::vector<InstrumentShape> instruments,
                  const InstrumentSceneOptions& options = {});

  /// A scene of places that are empty until set_instrument.
  InstrumentScene(std::span<const fields::ContactField> bones,
                  std::size_t places,
                  const InstrumentSceneOptions& options = {});

  /// From now on contacts are with what these cuts leave of the bones; they are read at each
  /// update. After anything that brings bone back (undo, a keyframe) call forget().
  /// @param cuts  one for each bone, in the same order; they must outlive the scene. Empty: none.
  void set_cuts(std::span<const fields::CutField> cuts) noexcept;

  [[nodiscard]] std::size_t bone_count() const noexcept { return bones_.size(); }
  [[nodiscard]] std::size_t instrument_count() const noexcept { return instruments_.size(); }

  /// Brings all pairs up to these poses, in the order of bones and instruments. What earlier
  /// updates left changes the cost, never an answer, not in the last bit. Real-time: noexcept, no
  /// allocation, only + - * / and sqrt.
  void update(std::span<const Pose<frame::Patient, frame::Bone>> patient_from_bone,
              std::span<const Pose<frame::Patient, frame::Tool>> patient_from_tool) noexcept;

  /// Puts another shape in a place, or none. Real-time. A shape that is too thick for a field is
  /// NotKnown to it.
  void set_instrument(std::size_t instrument, const InstrumentShape& shape) noexcept;
  void clear_instrument(std::size_t instrument) noexcept;

  /// The same as update(), for one instrument alone, whose alerts() are told apart. Real-time.
  void update_instrument(
      std::size_t instrument,
      const Pose<frame::Patient, frame::Tool>& patient_from_tool,
      std::span<const Pose<frame::Bone, frame::Patient>> bone_from_patient) noexcept;

  /// Of the last update; NotKnown before the first. Points and normals are in the bone's frame.
  [[nodiscard]] const SurfaceContact& contact(std::size_t instrument,
                                              std::size_t bone) const noexcept {
    return contacts_[instrument * bones_.size() + bone];
  }
  /// Pairs that touch, or whose outcome is NotKnown: what a tick must act on. By instrument, then
  /// by bone.
  [[nodiscard]] std::span<const InstrumentBonePair> alerts() const noexcept {
    return {alerts_.data(), alert_count_};
  }
  /// The same of one instrument, after update_instrument.
  [[nodiscard]] std::span<const InstrumentBonePair> alerts(std::size_t instrument) const noexcept {
    return {alerts_.data() + instrument * bones_.size(), own_alert_count_[instrument]};
  }

  [[nodiscard]] const InstrumentSceneCounts& counts() const noexcept { return counts_; }
  /// Looks at every pair anew at the next update.
  void forget() noexcept;

 private:
  /// What is kept of the last look at a pair. Every point of an axis moves by no more than the
  /// farther of its ends.
  struct Memory {
    Vec3 front;  ///< the axis's ends in the bone's frame
    Vec3 back;
    double slack_mm = -1;  ///< while neither has moved so far, the pair is Far
  };
  struct Axis {
    Vec3 front;
    Vec3 back;
  };

  /// Appends to `alerts` what of this instrument must be acted on.
  void update_pairs(std::size_t instrument,
                    const Pose<frame::Patient, frame::Tool>& tool,
                    std::span<const Pose<frame::Bone, frame::Patient>> bone_from_patient,
                    InstrumentBonePair* alerts,
                    std::size_t& count) noexcept;
  void look_at(std::size_t pair,
               std::size_t bone,
               const InstrumentShape& shape,
               const Pose<frame::Bone, frame::Tool>& bone_from_tool) noexcept;
  [[nodiscard]] double bound_by_box_and_ball(const fields::ContactField& field,
                                             const Memory& axis) const noexcept;
  void set_far(std::size_t pair,
               const fields::ContactField& field,
               const InstrumentShape& shape,
               double slack_mm) noexcept;

  std::span<const fields::ContactField> bones_;
  std::span<const fields::CutField> cuts_;
  std::vector<InstrumentShape> instruments_;
  InstrumentSceneOptions options_;
  std::vector<Memory> memory_;
  std::vector<SurfaceContact> contacts_;
  std::vector<Pose<frame::Bone, frame::Patient>> bone_from_patient_;
  std::vector<InstrumentBonePair> alerts_;
  std::size_t alert_count_ = 0;
  std::vector<std::size_t> own_alert_count_;
  std::vector<bool> is_empty_;
  InstrumentSceneCounts counts_;
};

}  // namespace carpus::contact

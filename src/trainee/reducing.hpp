// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a scripted operator's second hand reduces a displaced fracture: a joystick wire into one
// fragment, beside the way of the screw, by which it is led off the other, across to it, and down
// on it [clinical: B1 step 6].
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "anatomy/central_axis.hpp"
#include "anatomy/reduction.hpp"
#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"
#include "trainee/hand_motion.hpp"
#include "trainee/lying_structures.hpp"

namespace carpus::trainee {

class Reducing {
 public:
  /// Both must outlive it.
  Reducing(const cases::CaseData& data, const procedure::Procedure& procedure);

  /// How the fragments lie to each other now, as perfect pictures show it; nothing where there are
  /// no two, or no joystick is on the tray.
  [[nodiscard]] std::optional<anatomy::FractureOffset> offset(
      const simulation::Snapshot& now) const;

  /// @param hand      where the second hand is
  /// @param error     where this operator believes the other face's middle beside where it is,
  /// Patient
  ///                  [mm]
  void begin(const simulation::Snapshot& now, const HandPose& hand, const Vec3& error);

  /// Whether its wire stands in a fragment still.
  [[nodiscard]] bool has_left_wire() const noexcept { return left_ != simulation::kNoItem; }
  /// Takes that wire out again: the guide wire holds the fragments, and a joystick that stands out
  /// over the wrist would bend when it is straightened.
  void begin_taking_out();

  /// The second hand's part of the next tick's input. True once it has let go, whatever came of it.
  bool next(const simulation::Snapshot& now, simulation::Input& input);

 private:
  enum class Stage : std::uint8_t {
    Take,
    Come,
    Approach,
    Drive,
    Apart,
    Across,
    Together,
    LetGo,
    PickUp,
    DrawOut,
    Over
  };
  /// Where the wire goes in, Patient.
  struct Way {
    std::size_t body = 0;
    Vec3 entry;
    Vec3 inward;
  };
  /// A fragment's fracture face, Patient.
  struct Face {
    Vec3 middle;
    Vec3 normal;
  };

  void plan_axis();
  [[nodiscard]] std::optional<Way> find_way(const simulation::Snapshot& now) const;
  [[nodiscard]] Face face_of(const simulation::Snapshot& now, bool of_first) const;
  [[nodiscard]] static bool is_beside_structures(const std::vector<LyingPoint>& structures,
                                                 const Way& way);
  [[nodiscard]] Pose<frame::Patient, frame::Bone> led(const simulation::Snapshot& now,
                                                      std::size_t body) const;
  [[nodiscard]] Way led(const simulation::Snapshot& now, const Way& way) const;
  [[nodiscard]] double room_of(const simulation::Snapshot& now, std::size_t body) const;
  [[nodiscard]] bool is_way_free(const simulation::Snapshot& now, const Way& way) const;
  void enter(Stage stage);
  void drive(const simulation::Snapshot& now, simulation::Input& input);
  void lead(const simulation::Snapshot& now, simulation::Input& input);

  const cases::CaseData& case_;
  instruments::InstrumentIndex joystick_ = instruments::kNoInstrument;
  std::size_t first_ = 0;  ///< bodies of the two fragments
  std::size_t second_ = 0;
  std::optional<anatomy::Reduction> faces_;
  Pose<frame::Bone, frame::Bone> first_from_second_;  ///< once they are together
  BoneLine first_axis_;   ///< of the bone put together again, frame Bone of the first fragment ...
  BoneLine second_axis_;  ///< ... and of the second

  Stage stage_ = Stage::Over;
  std::uint8_t left_ = simulation::kNoItem;  ///< item that was let go of in a fragment
  Tick in_stage_ = 0;
  Way way_;
  HandPose hand_;
  MinimumJerkMove move_;
  Vec3 error_;
  double depth_mm_ = 0.0;  ///< when it was last looked at
  double lean_n_ = 0.0;
};

}  // namespace carpus::trainee

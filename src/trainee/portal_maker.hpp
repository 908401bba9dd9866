// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A scripted operator who makes portals through closed skin: pulls, feels, pricks, cuts, spreads,
// goes in, through the same input as a person. It knows where the portals are and misses them as
// its skill says: this proves the score and not people.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "cases/case_data.hpp"
#include "core/rng.hpp"
#include "procedure/procedure.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"
#include "trainee/hand_motion.hpp"
#include "trainee/skill.hpp"

namespace carpus::trainee {

/// What sets them apart [E]: nothing here says how people perform.
struct PortalSkill {
  double traction_n = 60.0;
  double speed_mm_per_s = 30.0;
  double in_mm_per_s = 8.0;       ///< under the skin
  double through_mm_per_s = 3.5;  ///< with the sheath
  double tremor_mm = 0.05;
  double place_error_mm = 0.5;  ///< of where it is pricked, by axis
  double tilt_error_deg = 2.5;  ///< of the needle, by axis
  int felt_across = 3;          ///< so many places along each side about what is felt for
  int tries = 4;                ///< of the needle
  double learning = 0.6;        ///< errors shrink by this with each
  double cut_mm = 4.5;
  double cut_error_mm = 0.25;
  double cut_turn_deg = 8.0;  ///< off the limb's axis
  double cut_deep_mm = 1.4;
  double foresees_mm = 0.7;  ///< of that a blade is held back: it goes on while one reacts
  double skips = 0.0;        ///< chance to leave out the needle, or to spread
  double reaction_s = 0.15;
  bool works_under_vision = true;  ///< where there is a scope: the second portal
  double looks_s = 1.6;            ///< at the needle in the joint, then
};
[[nodiscard]] PortalSkill portal_skill_of(Skill skill) noexcept;

class ScriptedPortalMaker {
 public:
  /// @throws InvalidInput  when it cannot be done on this case (the procedure's opening).
  ScriptedPortalMaker(const cases::CaseData& data,
                      const procedure::Procedure& procedure,
                      Skill skill,
                      std::uint64_t seed);

  /// The input for the next tick, from the state that the last one left.
  [[nodiscard]] simulation::Input next(const simulation::Snapshot& now);
  [[nodiscard]] bool is_done() const noexcept { return is_finished_; }
  /// From now on with this hand.
  void works_with(std::uint8_t hand) noexcept { works_ = hand; }
  /// Whether the portal that it makes now is one that a scope is to look at meanwhile.
  [[nodiscard]] bool works_under_vision() const noexcept;

 private:
  enum class Until : std::uint8_t { There, FluidBack, Made, Deep };
  struct Task {
    HandPose to;
    double mm_per_s = 0.0;
    Tick dwell = 0;
    Until until = Until::There;  ///< it ends sooner, a reaction after that
    bool takes = false;
    simulation::InstrumentIndex instrument = 0;
    bool opens = false;       ///< the clamp, meanwhile
    bool is_prick = false;    ///< tried again where no fluid came back
    bool cuts = false;        ///< from where it came to be so deep
    bool keeps_deep = false;  ///< led by how deep the blade is
    bool looks = false;       ///< at the cut: by that it goes on
    bool enters = false;      ///< tried again where it did not go in
    bool plans = false;       ///< the next portal, once it is begun
    bool ends = false;        ///< with the sheath, once the needle was in the opened way
    bool finishes = false;
  };
  struct Portal {
    Vec3 skin;
    Vec3 inwards;
    double capsule_mm = 0.0;
    Vec3 landmark;
    bool is_opened_first = false;
  };

  [[nodiscard]] Portal portal_now(std::size_t which) const;
  void plan_portal();
  void plan_prick(bool is_first);
  void plan_cut();
  void lead_blade(const simulation::Snapshot& now);
  void plan_way_in(const simulation::Snapshot& now);
  void plan_sheath();
  void plan_sheath_and_end();
  void feel(const Vec3& at, const Vec3& out);
  void take(const char* id);
  void go(const HandPose& to, double mm_per_s, double dwell_s = 0.0);
  [[nodiscard]] Vec3 across(const Vec3& inwards) const;
  [[nodiscard]] bool is_reached(const Task& task, const simulation::Snapshot& now) const;

  const cases::CaseData& data_;
  const procedure::Procedure& procedure_;
  PortalSkill skill_;
  Rng rng_;
  Tremor tremor_;
  simulation::WristPose wrist_;
  std::vector<Pose<frame::Patient, frame::Bone>> poses_;  ///< by body
  std::array<std::uint8_t, procedure::kPortalsMade> asked_{};
  std::deque<Task> tasks_;
  HandPose hand_;
  HandPose planned_;  ///< where the plan so far leaves it
  MinimumJerkMove move_;
  Tick in_task_ = 0;
  Tick move_ticks_ = 1;
  Tick reached_at_ = 0;
  std::size_t which_ = 0;
  std::uint8_t works_ = 0;  ///< hand
  Portal at_;
  double cut_deep_mm_ = 0.0;
  double lifted_mm_ = 0.0;  ///< of the blade, so that it keeps its depth
  Vec3 found_;              ///< where the needle was pricked last, on the skin
  Vec3 found_way_;          ///< and which way
  Vec3 skin_out_;           ///< out of the skin there, unit
  Vec3 cut_at_;             ///< the middle of the last cut
  bool skips_needle_ = false;
  int pricks_ = 0;
  int entries_ = 0;
  bool has_planned_ = false;
  bool is_finished_ = false;
};

}  // namespace carpus::trainee

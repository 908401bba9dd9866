// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A scripted operator of a diagnostic arthroscopy: pulls, goes from portal to portal, looks for
// each place of the tour from where it is seen and probes what is to be probed, through the same
// input as a person.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "arthroscopy/opened_space.hpp"
#include "arthroscopy/optics.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "cases/case_data.hpp"
#include "cases/joint_lesions.hpp"
#include "core/rng.hpp"
#include "procedure/procedure.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"
#include "trainee/hand_motion.hpp"
#include "trainee/skill.hpp"

namespace carpus::trainee {

/// Whether the procedure is one that this operator knows: a scope lies first on its tray.
[[nodiscard]] bool is_arthroscopy(const procedure::Procedure& procedure);

/// What sets them apart [E]: nothing here says how people perform.
struct ScopeSkill {
  double traction_n = 69.0;
  double speed_mm_per_s = 12.0;
  double tremor_mm = 0.05;
  double aim_error_mm = 0.1;    ///< of where the tip is led to
  double turn_error_deg = 4.0;  ///< of the shaft
  double tilt_deg = 4.0;        ///< by which the camera head is off
  double dwell_s = 1.4;         ///< on a place before going on
  int wanderings = 0;           ///< tries elsewhere before a place is found
  double falls_out = 0.0;       ///< chance of drawing back too far between two places
  double presses_mm = 1.3;      ///< with which the probe goes beyond what it touches
  double yields_n = 2.0;        ///< pressed more, the hand gives way
  double reaction_s = 0.4;
  double recognises = 0.96;  ///< chance to name what came into view
  double grades_right = 0.88;
  double invents = 0.02;  ///< chance to see something where nothing is
  double says_nothing = 0.0;
  int tries = 4;                ///< at an exercise before it is let be
  double leads_blind = 0.0;     ///< chance to move the probe without the scope after it
  double draws_mm_per_s = 4.0;  ///< what it has caught, out of the joint
  double looks_again = 1.0;     ///< chance to look for more once something is out
  double searches = 1.0;        ///< chance to look at each place of the tour for it
  double hasty = 0.0;           ///< chance to close the jaws on what is not between them
};
[[nodiscard]] ScopeSkill scope_skill_of(Skill skill) noexcept;

class ScriptedArthroscopist {
 public:
  /// @param map  by which it goes, and must outlive it; nullptr: the case's own.
  /// @throws InvalidInput  when it cannot be done on this case (the procedure's opening).
  ScriptedArthroscopist(const cases::CaseData& data,
                        const procedure::Procedure& procedure,
                        Skill skill,
                        std::uint64_t seed,
                        const cases::ArthroscopicMap* map = nullptr);

  /// What it may come to see and is asked about at the end; nullptr: nothing. Must outlive it.
  void examines(const cases::JointLesions* lesions) noexcept { lesions_ = lesions; }

  /// At first it goes in by this portal of the map, has these in its picture, and holds still.
  void watches_first(std::uint8_t portal, std::vector<cases::TourPoint> places);
  /// It has, and does.
  [[nodiscard]] bool holds_still() const noexcept { return has_planned_ && at_ >= tasks_.size(); }
  /// ... no longer: it goes on from there with all the rest.
  void goes_on() noexcept;

  /// The input for the next tick, from the state that the last one left.
  [[nodiscard]] simulation::Input next(const simulation::Snapshot& now);
  [[nodiscard]] bool is_done() const noexcept { return is_finished_; }

 private:
  enum class Jaws : std::uint8_t { AsTheyAre, Open, Closed };
  enum class DrillGoal : std::uint8_t { None, In, Hold, Round, Touch, Line };
  /// One thing to do, with the hand that does it.
  struct Task {
    std::uint8_t hand = 0;
    HandPose to;
    double shaft_turn_deg = 0.0;
    double camera_turn_deg = 0.0;
    Tick dwell = 0;
    bool takes_probe = false;
    instruments::InstrumentIndex takes = instruments::kNoInstrument;  ///< which tool that is
    bool turns = false;
    bool answers = false;  ///< all that is asked, one a tick
    bool finishes = false;
    DrillGoal goal = DrillGoal::None;  ///< of exercises: once it is reached the task is left out
    std::uint8_t count = 0;            ///< ... of which so many
    Jaws jaws = Jaws::AsTheyAre;
    bool seeks = false;           ///< what to do next is found out once it is begun
    double speed_mm_per_s = 0.0;  ///< 0: the usual
    bool turns_mouth = false;     ///< of a shaver, to `mouth_deg`
    double mouth_deg = 0.0;
    int inflow_steps = -1;  ///< to which the pump is set; -1: as it is
    int until_gone = -1;    ///< this piece of tissue; it goes on at once then
  };
  struct View {
    Vec3 tip;
    double turn_deg = 0.0;
    bool is_found = false;
  };

  struct Watch {
    std::uint8_t portal = 0;
    std::vector<cases::TourPoint> places;
  };

  void plan();
  void plan_tour();
  void plan_watch(const Watch& watch);
  void plan_finish();
  void take_probe(std::uint8_t portal);
  void begin(const simulation::Snapshot& now);
  struct Stop {
    std::uint8_t look = 0;  ///< portal of the scope
    std::uint8_t work = 0;  ///< of the probe
    bool is_probing = false;
    std::vector<std::size_t> points;  ///< in the map's order
  };
  [[nodiscard]] std::vector<Stop> stops() const;
  [[nodiscard]] std::uint8_t work_portal(std::uint8_t look) const;
  void enter(std::uint8_t hand, std::uint8_t portal);
  void draw_out(std::uint8_t hand);
  void look_at(const Stop& stop, const Vec3& place);
  void probe(const Stop& stop, const Vec3& place);
  void look_round(const Stop& stop);

  // drill_plan.cpp
  void plan_drill(const procedure::ScopeDrill& drill);
  void go_in(std::uint8_t hand, std::uint8_t portal);
  void plan_holds(const procedure::ScopeDrill& drill, const Stop& stop);
  void plan_round(const procedure::ScopeDrill& drill, const Stop& stop);
  void plan_touches(const procedure::ScopeDrill& drill, const Stop& stop);
  void plan_line(const procedure::ScopeDrill& drill, const Stop& stop);
  bool watch(const Stop& stop, std::span<const Vec3> places, double least_cosine, int turn);
  [[nodiscard]] double level_turn_deg(const HandPose& held, double shaft_turn_deg) const;
  void mark_since(std::size_t first, DrillGoal goal, std::size_t count);
  [[nodiscard]] std::size_t point_of(std::uint8_t number) const;
  [[nodiscard]] Vec3 place_to_look_round(std::uint8_t portal) const;
  [[nodiscard]] Vec3 on_surface(std::uint8_t joint, const Vec3& near, double presses_mm) const;
  [[nodiscard]] bool is_reached(const Task& task, const procedure::ScopeFacts& facts) const;

  // removal_plan.cpp
  void plan_removal();
  void seek(const simulation::Snapshot& now);
  void plan_catch(const simulation::LooseView& body);
  void plan_search();
  void plan_close(const simulation::Snapshot& now, const simulation::LooseView& body);
  void plan_bring_out();
  [[nodiscard]] std::uint8_t portal_for(const Vec3& at, int turn) const;
  [[nodiscard]] Vec3 comes_in_at(std::uint8_t portal, const Vec3& at) const;
  void plan_another_look(const simulation::Snapshot& now);
  [[nodiscard]] const simulation::LooseView* next_to_catch(const simulation::Snapshot& now) const;
  void go_on_seeking();

  // shaving_plan.cpp
  void plan_shaving();
  void seek_to_cut(const simulation::Snapshot& now);
  void come_to_piece(const Vec3& at, int turn, bool is_new);
  void plan_cut(const simulation::Snapshot& now, std::size_t piece);
  bool plan_press(const simulation::Snapshot& now);
  bool waits_until_clear(const simulation::Snapshot& now);
  [[nodiscard]] std::size_t next_to_cut(const simulation::Snapshot& now) const;
  [[nodiscard]] Vec3 piece_at(std::size_t piece) const;
  [[nodiscard]] Vec3 out_of_joint(std::size_t piece) const;

  // shaver_approach.cpp
  struct Approach {
    HandPose held;
    double mouth_deg = 0.0;
  };
  [[nodiscard]] Approach approach(std::uint8_t portal, std::size_t piece, double left) const;
  [[nodiscard]] double mouth_turn_deg(const HandPose& held, const Vec3& towards) const;
  [[nodiscard]] double room_about_shaver_mm(const HandPose& held) const;
  [[nodiscard]] bool is_in_mouth(const simulation::Snapshot& now, std::size_t piece) const;

  // punch_plan.cpp
  bool seek_to_bite(const simulation::Snapshot& now);
  [[nodiscard]] std::size_t next_to_bite(const simulation::Snapshot& now) const;
  void plan_bite(std::size_t piece);
  void change_tool(instruments::InstrumentIndex tool);

  // screw_plan.cpp
  void plan_screw_control();
  void control_in(std::uint8_t joint);
  [[nodiscard]] std::optional<Vec3> felt_by(std::uint8_t work, const Vec3& at) const;
  void look_from_elsewhere(const Stop& stop, const Vec3& at);
  [[nodiscard]] Stop stop_for(std::uint8_t joint, const Vec3& at) const;
  [[nodiscard]] std::uint8_t judged_of_screw(std::size_t asked, std::uint32_t lesions_seen);
  [[nodiscard]] std::uint8_t decided() const;

  [[nodiscard]] Vec3 place_of(std::size_t point) const;
  [[nodiscard]] Vec3 moved(const cases::TourPoint& point) const;
  [[nodiscard]] HandPose hole(std::uint8_t portal) const;
  [[nodiscard]] HandPose through(std::uint8_t portal, const Vec3& tip) const;
  [[nodiscard]] Vec3 in_portal(std::uint8_t portal, double beyond_capsule_mm) const;
  /// From where all of the places are seen.
  /// @param least_cosine  of the angle from the line of sight to each
  [[nodiscard]] View view_of(std::uint8_t portal,
                             std::span<const Vec3> places,
                             const Vec3& from,
                             double least_cosine,
                             double turn_step_deg) const;
  /// ... well within the round picture.
  [[nodiscard]] View view_of(std::uint8_t portal,
                             std::span<const Vec3> places,
                             const Vec3& from) const;
  [[nodiscard]] View view_of(std::uint8_t portal, const Vec3& point, const Vec3& from) const;
  [[nodiscard]] arthroscopy::OpenedSpace space_at(std::uint8_t joint, const Vec3& at) const;
  [[nodiscard]] bool has_room(std::uint8_t joint, const Vec3& tip, double room_mm) const;
  [[nodiscard]] bool goes_in(const Vec3& tip, std::uint8_t portal, double radius_mm) const;
  [[nodiscard]] bool is_in_metal(const Vec3& at, double radius_mm) const;
  [[nodiscard]] bool is_free(std::uint8_t joint, const Vec3& from, const Vec3& to) const;
  void give_way(const simulation::Snapshot& now);
  void go(std::uint8_t hand, const HandPose& to, double dwell_s);
  /// @param error_share  of the usual error of the turn
  void look(std::uint8_t portal, const View& view, double error_share = 1.0);
  [[nodiscard]] Vec3 error(double mm);
  void answer(const simulation::Snapshot& now, simulation::Input& input);
  [[nodiscard]] std::uint8_t judged(std::size_t finding, std::uint32_t lesions_seen);

  const cases::CaseData& data_;
  const procedure::Procedure& procedure_;
  const cases::ArthroscopicMap& map_;
  arthroscopy::Lens lens_;
  ScopeSkill skill_;
  Rng rng_;
  Tremor tremor_;
  procedure::Opening opening_;
  simulation::WristPose wrist_;
  /// Of the bones about the joints, as the wrist is pulled.
  std::vector<std::pair<const cases::Bone*, Pose<frame::Bone, frame::Patient>>> bones_;
  std::vector<Pose<frame::Patient, frame::Bone>> poses_;  ///< by body
  /// By hand: the portal that it is in; none where it is outside.
  std::array<std::uint8_t, simulation::kHands> in_{procedure::kNoBody, procedure::kNoBody};
  std::optional<Watch> watch_;
  std::vector<Task> tasks_;
  std::size_t at_ = 0;
  bool has_planned_ = false;
  bool has_begun_ = false;
  bool is_finished_ = false;
  std::array<HandPose, simulation::kHands> hands_{};
  MinimumJerkMove move_;
  std::array<Vec3, simulation::kHands> given_{};  ///< by which the hands gave way
  Tick in_task_ = 0;
  Tick move_ticks_ = 1;
  const cases::JointLesions* lesions_ = nullptr;
  const arthroscopy::PathologyTable* asked_ = nullptr;  ///< nullptr: nothing is
  std::size_t answered_ = 0;
  cases::Grades said_ = cases::not_judged();
  double turn_deg_ = 0.0;
  double tilt_deg_ = 0.0;
  std::array<Vec3, simulation::kHands> planned_{};  ///< where the plan so far leaves each tip
  double planned_turn_deg_ = 0.0;
  // Of removing what is loose.
  Stop working_;
  bool has_probe_ = false;
  bool are_closed_ = false;
  std::array<std::uint8_t, cases::kMaxLesions> tried_{};  ///< to catch each, so often
  int looks_ = 0;
  int brought_ = 0;  ///< tried to bring out, so often
  std::uint8_t out_when_looked_ = 0;
  // Of shaving.
  std::array<std::uint8_t, cases::kMaxPieces> cut_tries_{};
  std::uint8_t last_patch_ = cases::kMaxPatches;
  Vec3 last_cut_{};
  bool is_before_ = false;  ///< the mouth was brought to a piece ...
  std::size_t before_ = 0;  ///< ... this one
  int pressed_ = 0;         ///< ... and the pedal pressed there, so often
  /// What is taken in the working hand, and what is in it; of a punch where one is on the tray.
  instruments::InstrumentIndex tool_;
  instruments::InstrumentIndex in_hand_ = instruments::kNoInstrument;
  instruments::InstrumentIndex punch_ = instruments::kNoInstrument;
  std::array<std::uint8_t, cases::kMaxPieces> bite_tries_{};
  Vec3 watched_{};         ///< what the scope was led to
  bool is_over_ = false;   ///< the open jaws were brought over a body ...
  std::uint8_t over_ = 0;  ///< ... this one
};

}  // namespace carpus::trainee

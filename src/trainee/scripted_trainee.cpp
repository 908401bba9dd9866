// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/scripted_trainee.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "simulation/c_arm_angles.hpp"
#include "trainee/detail/hand_commands.hpp"

namespace carpus::trainee {
namespace {

using detail::kind_of;
using detail::kWristTicks;
using detail::of_hand;
using instruments::InstrumentIndex;
using instruments::Work;
using simulation::CommandKind;
using simulation::Driver;
using simulation::HandInput;
using simulation::Input;
using simulation::ItemView;
using simulation::Snapshot;

constexpr double kStandoffMm = 18.0;       // from where the last straight approach starts
constexpr double kBehindSleeveMm = 60.0;   // where a sleeve leads: from behind it
constexpr double kFirstStandoffMm = 45.0;  // where the hand waits during the survey
constexpr double kPressMm = 0.5;           // hand beyond the surface, so that the tip rests on it
constexpr Tick kMostTicks = 900000;        // 15 min: whoever has not finished by then gives up
constexpr Tick kEngageTicks = 2500;
constexpr double kPosedRad = 0.002;
constexpr Tick kPhaseTicks = 60000;
constexpr int kMostTries = 8;

Tick ticks_of(double seconds) { return static_cast<Tick>(seconds / kTickSeconds); }

BoneSolid solid_of(const cases::CaseData& data) {
  std::vector<const MeshIn<frame::Bone>*> fragments;
  for (const cases::Bone* part : cases::scaphoid_parts(data)) fragments.push_back(&part->surface);
  return BoneSolid(fragments);
}

/// The same as the fragments lie now, seen from one of them.
BoneSolid solid_of(const cases::CaseData& data, const Snapshot& now, std::size_t seen_from) {
  const auto from_patient = now.patient_from_bone[seen_from].inverse();
  std::vector<MeshIn<frame::Bone>> fragments;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone != BoneId::Scaphoid) continue;
    fragments.push_back(from_patient * now.patient_from_bone[b] * data.bones[b].surface);
  }
  std::vector<const MeshIn<frame::Bone>*> parts;
  for (const auto& fragment : fragments) parts.push_back(&fragment);
  return BoneSolid(parts);
}

std::size_t body_of(const cases::CaseData& data, BoneId bone) {
  std::size_t body = 0;
  while (body < data.bones.size() && data.bones[body].bone != bone) ++body;
  return body;
}

/// The fragment of a broken bone, the first body of a whole one.
std::size_t body_of(const cases::CaseData& data, BoneId bone, BonePart part) {
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone == bone && data.bones[b].part == part) return b;
  }
  return body_of(data, bone);
}

}  // namespace

ScriptedTrainee::ScriptedTrainee(const cases::CaseData& data,
                                 const procedure::Procedure& procedure,
                                 Skill skill,
                                 std::uint64_t seed)
    : case_(data),
      procedure_(procedure),
      opening_(procedure.opening(data)),
      target_(body_of(data, procedure.target)),
      profile_(profile_of(skill)),
      rng_(seed * kSkillCount + static_cast<std::uint64_t>(skill)),
      tremor_(profile_.tremor_mm, Rng(seed ^ 0x7265746Du)),
      scaphoid_(solid_of(data)),
      reducing_(data, procedure),
      sleeve_(procedure),
      uses_sleeve_(sleeve_.is_offered() && rng_.uniform(0, 1) < profile_.sleeve_share) {
  bool has_screw = false;
  for (const InstrumentIndex index : procedure.tray) {
    if (kind_of(index).is_gauge) gauge_ = index;
    has_screw = has_screw || kind_of(index).work == Work::Thread;
  }
  for (const procedure::Step& step : procedure.steps) {
    const auto& actions = step.actions;
    const bool asks = std::find(actions.begin(), actions.end(), "pick_up_far_end") != actions.end();
    draws_through_ = draws_through_ || (asks && profile_.draws_wire_through);
    const bool is_known = step.instrument < instruments::catalogue().size();
    if (is_known && kind_of(step.instrument).work == Work::Ream) drill_ = step.instrument;
  }
  const bool is_fixation = procedure.target == BoneId::Scaphoid && has_screw &&
                           gauge_ != instruments::kNoInstrument &&
                           kind_of(procedure.tray.front()).work == Work::Drill;
  if (!is_fixation) {
    throw InvalidInput("scripted trainees fix the scaphoid by a wire and a screw; " + procedure.id +
                       " is another operation");
  }
  // The hand waits on the side from which the bone is reached.
  const cases::AxisSegment& axis = data.scaphoid.central_axis;
  const bool from_proximal = distance(opening_.tip_in_target, axis.proximal) <=
                             distance(opening_.tip_in_target, axis.distal);
  near_end_ = from_proximal ? axis.proximal : axis.distal;
  far_end_ = from_proximal ? axis.distal : axis.proximal;
  near_body_ =
      body_of(data, procedure.target, from_proximal ? BonePart::Proximal : BonePart::Distal);
  far_body_ =
      body_of(data, procedure.target, from_proximal ? BonePart::Distal : BonePart::Proximal);
}

ItemView ScriptedTrainee::held(const Snapshot& now) {
  const std::uint8_t item = now.hands[0].item;
  return item < simulation::kMaxItems ? now.items[item] : ItemView{};
}

Vec3 ScriptedTrainee::near_end(const Snapshot& now) const {
  return (now.patient_from_bone[near_body_] * Point<frame::Bone>{near_end_}).v;
}

Vec3 ScriptedTrainee::far_end(const Snapshot& now) const {
  return (now.patient_from_bone[far_body_] * Point<frame::Bone>{far_end_}).v;
}

Vec3 ScriptedTrainee::turned(const Snapshot& now, const Vec3& in_target) const {
  return (now.patient_from_bone[target_] * Direction<frame::Bone>{in_target}).v;
}

/// A unit vector across the axis, any way round: the larger of random tries is as even as needed.
Vec3 ScriptedTrainee::random_across() {
  const Vec3 axis = normalized_or(far_end_ - near_end_, {0, 0, 1});
  Vec3 across;
  do {
    const Vec3 any{rng_.uniform(-1, 1), rng_.uniform(-1, 1), rng_.uniform(-1, 1)};
    across = any - axis * dot(any, axis);
  } while (squared_length(across) < 0.01);
  return normalized_or(across, any_perpendicular(axis));
}

/// One draw after the other, in this order: in one expression compilers would choose.
Vec3 ScriptedTrainee::random_error(const Range& range_mm) {
  const double error_mm = draw(range_mm) * error_scale_;
  return random_across() * error_mm;
}

/// Where the trainee believes that the axis runs, for this try.
void ScriptedTrainee::plan_line(const Snapshot& now) {
  planned_entry_ = near_end(now) + turned(now, random_error(profile_.entry_error_mm));
  const Vec3 aim = far_end(now) + turned(now, random_error(profile_.aim_error_mm));
  planned_direction_ = normalized_or(aim - planned_entry_, {0, 0, 1});
  thrust_n_ = draw(profile_.drive_thrust_n);
  stop_depth_mm_ = -1.0;
}

void ScriptedTrainee::enter(Phase phase, const Snapshot& now) {
  phase_ = phase;
  in_phase_ = 0;
  wait_ = ticks_of(draw(profile_.reaction_s));
  next_shot_ = 0;
  lean_n_ = 0.0;
  last_depth_mm_ = -1e9;
  if (phase == Phase::LookReduced) plan_on_reduced_bone(now);
  plan_shots(now);
  if (phase == Phase::PlaceSleeve) {
    start_move({planned_entry_ - planned_direction_ * kBehindSleeveMm, -planned_direction_});
    sleeve_.begin(second_hand(), planned_entry_, planned_direction_, profile_.speed_mm_per_s);
  } else if (phase == Phase::GoToStandoff) {
    const double far = uses_sleeve_ ? kBehindSleeveMm : kStandoffMm;
    start_move({planned_entry_ - planned_direction_ * far, -planned_direction_});
  } else if (phase == Phase::Approach) {
    start_move({planned_entry_ + planned_direction_ * (kPressMm + 1.0), -planned_direction_});
  } else if (phase == Phase::Ream) {
    ream_depth_mm_ = true_chord(now, held(now)) - draw(profile_.ream_before_far_mm);
  } else if (phase == Phase::Reduce) {
    reducing_.begin(now, second_hand(), turned(now, random_error(profile_.reduction_error_mm)));
  } else if (phase == Phase::FreeFragment) {
    reducing_.begin_taking_out();
  } else if (phase == Phase::Insert) {
    bury_mm_ = draw(profile_.bury_mm);
  }
}

void ScriptedTrainee::try_again(const Snapshot& now) {
  plan_line(now);
  enter(uses_sleeve_ ? Phase::PlaceSleeve : Phase::GoToStandoff, now);
}

void ScriptedTrainee::start_move(const HandPose& target) {
  const double way = distance(hand_.tip, target.tip) + 40.0 * distance(hand_.shaft, target.shaft);
  move_ = MinimumJerkMove(hand_, target, ticks_of(0.3 + way / profile_.speed_mm_per_s));
  in_move_ = 0;
}

/// How the C-arm stands to look down the bone as it lies now, as far as it tilts.
ScriptedTrainee::PlannedShot ScriptedTrainee::down_the_bone(const Snapshot& now) const {
  const Vec3 line = normalized_or(near_end(now) - far_end(now), {0, 0, 1});
  Vec3 source = (case_.wrist_from_patient * Direction<frame::Patient>{line}).v;
  if (source.z > 0) source = -source;  // from dorsal: the picture is the same
  const double radial = case_.side == Side::Left ? -source.y : source.y;
  const double tilt = degrees_from_radians(std::asin(std::clamp(source.x, -1.0, 1.0)));
  return {degrees_from_radians(std::atan2(radial, -source.z)),
          std::clamp(tilt, -simulation::kGreatestTiltDeg, simulation::kGreatestTiltDeg)};
}

void ScriptedTrainee::plan_shots(const Snapshot& now) {
  shots_.clear();
  if (phase_ == Phase::Survey) {
    shots_ = {{0, 0}, {90, 0}};
  }
  if (phase_ == Phase::LookReduced || phase_ == Phase::Check || phase_ == Phase::LookExtended ||
      phase_ == Phase::Verify) {
    shots_ = {{0, 0}, {90, 0}};
    const bool is_quick = phase_ == Phase::LookReduced || phase_ == Phase::LookExtended;
    if (!is_quick && profile_.checks_oblique) shots_.insert(shots_.end(), {{45, 0}, {0, 30}});
  }
  // Reduced, the bone points elsewhere, and the ring is to be looked for again.
  const bool looks_for_ring = phase_ == Phase::Survey || phase_ == Phase::LookReduced;
  if (looks_for_ring && profile_.finds_ring) shots_.push_back(down_the_bone(now));
  if (shots_.empty()) return;
  for (int i = 0; i < profile_.repeated_shots; ++i) {
    shots_.push_back({rng_.uniform(-10, 10), 0});
  }
}

/// Takes the next planned picture, one each 0.8 s; true when all are taken.
bool ScriptedTrainee::shoot(Input& input) {
  constexpr Tick kBetweenShots = 800;
  if (next_shot_ >= shots_.size()) return true;
  if (in_phase_ % kBetweenShots == kBetweenShots - 1) {
    const PlannedShot& shot = shots_[next_shot_++];
    input.command.kind = CommandKind::TakeShot;
    input.command.rotation_deg = shot.rotation_deg;
    input.command.tilt_deg = shot.tilt_deg;
  }
  return false;
}

/// Greatest distance of the line from the axis at its two ends, as the pictures show it [mm].
double ScriptedTrainee::offset_of_line(const Snapshot& now) const {
  const ItemView wire = held(now);
  double greatest = 0;
  for (const Vec3& end : {near_end(now), far_end(now)}) {
    const Vec3 w = end - wire.entry_in_patient;
    greatest = std::max(greatest, length(cross(w, wire.shaft_in_patient)));
  }
  return greatest;
}

/// Length of the wire's line in the bone from its entry, as it could be read off perfect pictures.
double ScriptedTrainee::true_chord(const Snapshot& now, const ItemView& wire) const {
  const auto bone_from_patient = now.patient_from_bone[target_].inverse();
  const Vec3 entry = (bone_from_patient * Point<frame::Patient>{wire.entry_in_patient}).v;
  const Vec3 along = (bone_from_patient * Direction<frame::Patient>{-wire.shaft_in_patient}).v;
  const auto chord = scaphoid_.chord_through(entry + along, along);
  return chord ? chord->leave_mm + 1.0 : 20.0;
}

void ScriptedTrainee::judge_line(const Snapshot& now) {
  const bool is_in = held(now).in_target;
  if ((!is_in || offset_of_line(now) > profile_.noticed_error_mm) &&
      tries_ + 1 < profile_.most_passes) {
    ++tries_;
    error_scale_ *= profile_.learning;
    enter(Phase::Withdraw, now);
  } else {
    const bool goes_on = draws_through_ && is_in && is_way_out_free(now);
    is_drawn_through_ = goes_on;
    after_freeing_ = goes_on ? Phase::DriveThrough : is_in ? Phase::Measure : Phase::Finish;
    after_sleeve_ = reducing_.has_left_wire() ? Phase::FreeFragment : after_freeing_;
    enter(sleeve_.is_held() ? Phase::PutSleeveDown : after_sleeve_, now);
  }
}

/// What the state says about going on to the next phase.
void ScriptedTrainee::think(const Snapshot& now) {
  switch (phase_) {
    case Phase::GoToStandoff:
      if (move_.is_over(in_move_)) enter(Phase::Approach, now);
      return;
    case Phase::Approach:
      if (move_.is_over(in_move_) ||
          (now.hands[0].touching && now.hands[0].contact_depth_mm > kPressMm)) {
        enter(Phase::Engage, now);
      }
      return;
    case Phase::Engage:
    case Phase::Drive:
    case Phase::Judge:
    case Phase::Withdraw:
      return think_of_line(now);
    case Phase::DriveThrough:
    case Phase::DrawThrough:
    case Phase::PushBack:
    case Phase::DrawBack:
      return think_of_drawing_through(now);
    case Phase::HoldWire:
      if (held(now).far_end_is_out || in_phase_ > kPhaseTicks) enter(Phase::Ream, now);
      return;
    case Phase::Ream:
      if (held(now).instrument == drill_ &&
          (held(now).depth_mm >= ream_depth_mm_ || in_phase_ > kPhaseTicks)) {
        enter(Phase::DrillOut, now);
      }
      return;
    case Phase::DrillOut:  // the hand has the wire again when the drill is off
      if (held(now).wire == simulation::kNoItem) enter(Phase::Choose, now);
      return;
    case Phase::Insert:
      if (held(now).buried_mm >= bury_mm_ || in_phase_ > kPhaseTicks) enter(Phase::Verify, now);
      return;
    case Phase::DrawWire:
      if (held(now).body == simulation::kNoBody || in_phase_ > kPhaseTicks) {
        hand_ = {held(now).tip_in_patient, held(now).shaft_in_patient};
        enter(Phase::LetGo, now);  // and whatever other wire is left
      }
      return;
    default:
      return;
  }
}

void ScriptedTrainee::think_of_line(const Snapshot& now) {
  const ItemView wire = held(now);
  const bool is_fixed = wire.body != simulation::kNoBody;
  switch (phase_) {
    case Phase::Engage:
      if (is_fixed) {
        enter(Phase::Drive, now);
      } else if (in_phase_ > kEngageTicks) {  // skated or missed: look again, closer
        error_scale_ *= 0.7;
        if (++tries_ < kMostTries) {
          try_again(now);
        } else {
          enter(Phase::Finish, now);
        }
      }
      return;
    case Phase::Drive:
      if (stop_depth_mm_ >= 0 && wire.depth_mm >= stop_depth_mm_) {
        enter(Phase::Check, now);
      } else if (in_phase_ > kPhaseTicks) {
        enter(Phase::Check, now);
      }
      return;
    case Phase::Judge:
      return judge_line(now);
    case Phase::Withdraw:
      if (!is_fixed) {
        hand_ = {wire.tip_in_patient, wire.shaft_in_patient};
        try_again(now);
      }
      return;
    default:
      return;
  }
}

/// Whether no bone lies in the wire's way out of the skin, nor a tendon, artery or nerve as far as
/// this trainee knows them: where one does, it is not driven on.
bool ScriptedTrainee::is_way_out_free(const Snapshot& now) const {
  constexpr double kBesideMm = 2.0;
  constexpr double kWayMm = 60.0;
  const ItemView wire = held(now);
  const Vec3 along = -wire.shaft_in_patient;
  for (std::size_t b = 0; b < case_.bones.size(); ++b) {
    const BoneId bone = case_.bones[b].bone;
    const auto& allowed = procedure_.allowed;
    if (bone == procedure_.target ||
        std::find(allowed.begin(), allowed.end(), bone) != allowed.end()) {
      continue;
    }
    for (const Vec3& vertex : case_.bones[b].surface.vertices) {
      const Vec3 w =
          (now.patient_from_bone[b] * Point<frame::Bone>{vertex}).v - wire.tip_in_patient;
      const double ahead = dot(w, along);
      if (ahead > 0.0 && ahead < kWayMm && length(w - along * ahead) < kBesideMm) return false;
    }
  }
  for (const LyingPoint& point : structures_now(case_, now)) {
    const Vec3 w = point.at - wire.tip_in_patient;
    const double ahead = dot(w, along);
    if (ahead > 0.0 && ahead < kWayMm &&
        length(w - along * ahead) < point.radius_mm + profile_.beside_structures_mm) {
      return false;
    }
  }
  return true;
}

void ScriptedTrainee::think_of_drawing_through(const Snapshot& now) {
  constexpr double kFlushMm = 0.0;
  constexpr double kEnoughMm = 60.0;  // of the near end, to work over
  constexpr Tick kBlockedTicks = 20000;
  const ItemView wire = held(now);
  const double out_mm = wire.length_mm - wire.depth_mm;
  const bool is_blocked = in_phase_ > kBlockedTicks;
  switch (phase_) {
    case Phase::DriveThrough:
      if (wire.far_end_is_out || is_blocked) enter(Phase::TakeFarEnd, now);
      return;
    case Phase::DrawThrough:
      if (out_mm <= kFlushMm || is_blocked) {
        wrist_.flexion_rad = 0.0;
        enter(Phase::LookExtended, now);
      }
      return;
    case Phase::PushBack:
      if (out_mm >= kEnoughMm || is_blocked) enter(Phase::TakeNearEnd, now);
      return;
    case Phase::DrawBack:
      if (wire.depth_mm <= stop_depth_mm_ || is_blocked) enter(Phase::Measure, now);
      return;
    default:
      return;
  }
}

/// Whether the pictures show a fracture that this trainee would not fix as it lies.
bool ScriptedTrainee::is_seen_apart(const Snapshot& now) const {
  const auto offset = reducing_.offset(now);
  return offset && std::max(offset->gap_mm, offset->step_mm) > profile_.noticed_displacement_mm;
}

/// What this trainee says of the fracture: a gap that a scan makes of a line is none [E].
simulation::Command ScriptedTrainee::judgement(const Snapshot& now) const {
  constexpr double kLineMm = 1.5;
  const auto offset = reducing_.offset(now);
  const double noticed_mm = std::max(kLineMm, profile_.noticed_displacement_mm);
  const bool is_displaced = offset && std::max(offset->gap_mm, offset->step_mm) > noticed_mm;
  simulation::Command command = of_hand(CommandKind::Judge, 0);
  command.index = static_cast<std::uint8_t>(is_displaced ? procedure::Judgement::Displaced
                                                         : procedure::Judgement::Aligned);
  return command;
}

/// Before anything is drilled: a fracture that is seen apart is reduced first, once.
void ScriptedTrainee::look_at_bone(const Snapshot& now, Input& input) {
  // PA and lateral are seen: how it lies is said before the next picture.
  constexpr std::size_t kJudgedAfter = 2;
  const bool is_survey = phase_ == Phase::Survey;
  if (is_survey && procedure_.judges_displacement && !has_judged_ && next_shot_ >= kJudgedAfter) {
    input.command = judgement(now);
    has_judged_ = true;
    return;
  }
  if (!shoot(input)) return;
  if (is_survey && is_seen_apart(now)) return enter(Phase::Reduce, now);
  try_again(now);
}

/// The bone is another one now: its axis is read off the pictures anew.
void ScriptedTrainee::plan_on_reduced_bone(const Snapshot& now) {
  scaphoid_ = solid_of(case_, now, target_);
  const auto found = find_central_axis(scaphoid_, near_end_ - far_end_);
  if (!found) return;
  near_end_ = found->axis.start;
  far_end_ = found->axis.end;
  near_body_ = far_body_ = target_;
}

/// Where the procedure leaves it to the operator, the wrist is posed before anything else is
/// thought of: hands stay where they wait.
bool ScriptedTrainee::is_posing(const Snapshot& now, Input& input) {
  const procedure::WristPose& wanted = opening_.wrist;
  const bool is_posed =
      std::abs(now.wrist.flexion_rad - wanted.flexion_rad) < kPosedRad &&
      std::abs(now.wrist.radial_deviation_rad - wanted.radial_deviation_rad) < kPosedRad;
  if (has_begun_ || !opening_.at_first || is_posed || ++posing_ > kWristTicks) return false;
  input.wrist = wanted;
  for (HandInput& hand : input.hands) {
    hand.tip_in_patient = held(now).tip_in_patient;
    hand.shaft_in_patient = held(now).shaft_in_patient;
  }
  return true;
}

Input ScriptedTrainee::next(const Snapshot& now) {
  Input input;
  if (is_posing(now, input)) return input;
  if (!has_begun_) {
    has_begun_ = true;
    wrist_ = opening_.wrist;
    const Vec3 away = normalized_or(near_end(now) - far_end(now), {0, 0, 1});
    hand_ = {near_end(now) + away * kFirstStandoffMm, away};
    enter(Phase::Survey, now);
  }
  if (phase_ != Phase::Done) {
    ++total_;
    if (total_ > kMostTicks && phase_ != Phase::Finish) enter(Phase::Finish, now);
    think(now);
    if (wait_ > 0) {
      --wait_;
    } else {
      ++in_phase_;
      if (phase_ == Phase::PlaceSleeve || phase_ == Phase::GoToStandoff ||
          phase_ == Phase::Approach) {
        hand_ = move_.at(++in_move_);
      }
      act(now, input);
    }
  }
  input.wrist = wrist_;
  // Once an instrument is in bone the hand rests on it; its tremor is held by the driver's guide.
  const ItemView item = held(now);
  const bool is_held = item.body != simulation::kNoBody;
  input.hands[0].tip_in_patient = is_held ? item.tip_in_patient : hand_.tip + tremor_.next();
  input.hands[0].shaft_in_patient = is_held ? item.shaft_in_patient : hand_.shaft;
  const bool is_second_busy = phase_ == Phase::Reduce || phase_ == Phase::FreeFragment;
  if (sleeve_.is_held()) {
    sleeve_.keep(input);
  } else if (!is_second_busy || wait_ > 0) {
    const HandPose beside = second_hand();
    input.hands[1].tip_in_patient = beside.tip;
    input.hands[1].shaft_in_patient = beside.shaft;
  }
  return input;
}

}  // namespace carpus::trainee

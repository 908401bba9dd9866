// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/view_debrief.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "session/exercise_pictures.hpp"
#include "session/metal_in_beam.hpp"
#include "simulation/c_arm_angles.hpp"
#include "view_trainer/fracture_fault.hpp"
#include "view_trainer/outline_message.hpp"
#include "view_trainer/placement_fault.hpp"
#include "view_trainer/silhouette.hpp"

namespace carpus::server {

namespace {

using view_trainer::PosedView;

/// A screw that has gone no farther than this since lies as it does at the end [mm].
constexpr double kSamePlaceMm = 0.05;
/// Pictures told of beside the presets: the message takes 32 in all.
constexpr std::size_t kMostTaken = 24;
constexpr std::size_t kMostWires = 8;
/// Pieces that lie alike to this lie alike [mm]; of so many ways to lie the newest are kept.
constexpr double kAlikeMm = 0.02;
constexpr std::size_t kMostLying = 4;

using Place = Pose<frame::Bone, frame::Bone>;

std::size_t first_fragment(const cases::CaseData& data) {
  const auto it = std::find_if(data.bones.begin(), data.bones.end(), [](const cases::Bone& bone) {
    return bone.bone == BoneId::Scaphoid;
  });
  return static_cast<std::size_t>(it - data.bones.begin());
}

/// Where each piece of the scaphoid lies, seen from the first of them.
std::vector<Place> places_at(const cases::CaseData& data, const simulation::Snapshot& now) {
  const auto first_from_patient = now.patient_from_bone.at(first_fragment(data)).inverse();
  std::vector<Place> places;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone == BoneId::Scaphoid) {
      places.push_back(first_from_patient * now.patient_from_bone.at(b));
    }
  }
  return places;
}

bool are_alike(const std::vector<Place>& one, const std::vector<Place>& other, const Vec3& middle) {
  constexpr double kReachMm = 15;
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (const Vec3& way : {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const Point<frame::Bone> p{middle + way * kReachMm};
      if (distance((one[i] * p).v, (other[i] * p).v) > kAlikeMm) return false;
    }
  }
  return true;
}

/// The case without its scan, the scaphoid's pieces in one frame as they lie.
cases::CaseData with_pieces_at(const cases::CaseData& data, const std::vector<Place>& places) {
  cases::CaseData lying;
  lying.side = data.side;
  lying.wrist_from_patient = data.wrist_from_patient;
  lying.scaphoid = data.scaphoid;
  lying.hand_motion = data.hand_motion;
  std::size_t piece = 0;
  for (const cases::Bone& bone : data.bones) {
    cases::Bone& copy = lying.bones.emplace_back();
    copy.bone = bone.bone;
    copy.part = bone.part;
    copy.patient_from_bone = bone.patient_from_bone;
    copy.surface = bone.bone == BoneId::Scaphoid ? places[piece++] * bone.surface : bone.surface;
  }
  return lying;
}

PosedView posed_of(const cases::CaseData& data, const TakenShot& shot) {
  const simulation::Snapshot& now = shot.snapshot;
  PosedView posed;
  posed.c_arm =
      session::beam_of(data, {shot.target, shot.rotation_deg, shot.tilt_deg}, shot.snapshot);
  posed.patient_from_bone.assign(now.patient_from_bone.begin(),
                                 now.patient_from_bone.begin() + now.body_count);
  posed.patient_from_scaphoid = posed.patient_from_bone.at(first_fragment(data));
  // The pieces come in the first one's frame.
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone == BoneId::Scaphoid) {
      posed.patient_from_bone[b] = posed.patient_from_scaphoid;
    }
  }
  return posed;
}

bool is_fixed_in_scaphoid(const cases::CaseData& data, const simulation::ItemView& item) {
  return item.instrument < instruments::catalogue().size() && item.body < data.bones.size() &&
         data.bones[item.body].bone == BoneId::Scaphoid;
}

instruments::Work work_of(const simulation::ItemView& item) {
  return instruments::catalogue()[item.instrument].work;
}

protocol::ScrewPlace place_of(view_trainer::Region region) {
  switch (region) {
    case view_trainer::Region::Distal:
      return protocol::ScrewPlace::Distal;
    case view_trainer::Region::Proximal:
      return protocol::ScrewPlace::Proximal;
    case view_trainer::Region::Side:
      break;
  }
  return protocol::ScrewPlace::Side;
}

/// From the focal spot to the waist, unit, in the frame of the scaphoid's first piece.
Vec3 ray_of(const PosedView& posed, const Vec3& waist) {
  const auto source = posed.patient_from_scaphoid.inverse() * posed.c_arm.source_in_patient();
  return normalized_or(waist - source.v, {0, 0, 1});
}

std::vector<view_trainer::StandardView> all_presets() {
  const auto views = view_trainer::standard_views();
  return {views.begin(), views.end()};
}

}  // namespace

struct ViewDebrief::Lying {
  Lying(const cases::CaseData& data, std::vector<Place> where)
      : places(std::move(where)), bones(with_pieces_at(data, places)), scaphoid(bones) {}
  std::vector<Place> places;
  cases::CaseData bones;
  view_trainer::ScaphoidSurface scaphoid;
};

ViewDebrief::ViewDebrief(const cases::CaseData& data) : data_(data) {
  const std::vector<const cases::Bone*> pieces = cases::scaphoid_parts(data);
  if (pieces.empty()) {
    throw InvalidInput("views are judged for the scaphoid, and the case has none");
  }
  if (pieces.size() == 2) {
    faces_ = anatomy::reduction_of(pieces[0]->surface, pieces[1]->surface);
  }
}

ViewDebrief::~ViewDebrief() = default;

const ViewDebrief::Lying& ViewDebrief::lying_at(const simulation::Snapshot& now) {
  std::vector<Place> places = places_at(data_, now);
  const auto it = std::find_if(lying_.begin(), lying_.end(), [&](const auto& each) {
    return are_alike(each->places, places, data_.scaphoid.waist);
  });
  if (it != lying_.end()) return **it;
  if (lying_.size() >= kMostLying) lying_.erase(lying_.begin());
  return *lying_.emplace_back(std::make_unique<Lying>(data_, std::move(places)));
}

std::optional<view_trainer::PlacedScrew> ViewDebrief::screw_in(const cases::CaseData& data,
                                                               const simulation::Snapshot& now) {
  for (const simulation::ItemView& item : now.items) {
    if (!is_fixed_in_scaphoid(data, item) || work_of(item) != instruments::Work::Thread) continue;
    const auto bone_from_patient = now.patient_from_bone[first_fragment(data)].inverse();
    return view_trainer::PlacedScrew{
        item.instrument, (bone_from_patient * Point<frame::Patient>{item.tip_in_patient}).v,
        (bone_from_patient * Direction<frame::Patient>{item.shaft_in_patient}).v};
  }
  return std::nullopt;
}

protocol::PictureTruth ViewDebrief::truth_of(const TakenShot& shot) {
  const simulation::Snapshot& now = shot.snapshot;
  const view_trainer::ScaphoidSurface& scaphoid = lying_at(now).scaphoid;
  const PosedView posed = posed_of(data_, shot);
  const view_trainer::OutlineMap bone = silhouette_of(scaphoid, posed);
  protocol::PictureTruth truth;
  truth.bone = view_trainer::outline_messages(bone);
  if (const auto screw = screw_in(data_, now)) {
    truth.screws.push_back(view_trainer::outline_message(screw_outline(*screw, posed)));
  }
  for (const simulation::ItemView& item : now.items) {
    if (!is_fixed_in_scaphoid(data_, item) || work_of(item) != instruments::Work::Drill) continue;
    simulation::Snapshot alone;
    alone.items[0] = item;
    for (const fluoroscopy::MetalCylinder& rod : session::metal_in_beam(alone)) {
      if (truth.wires.size() >= kMostWires) break;
      truth.wires.push_back(
          view_trainer::outline_message(view_trainer::rod_outline(rod, posed.c_arm)));
    }
    const Vec3 tip =
        (posed.patient_from_scaphoid.inverse() * Point<frame::Patient>{item.tip_in_patient}).v;
    const double out_mm = scaphoid.signed_distance(tip);
    // Before it is in, the tip is out where it came from; out of the skin it was drawn through.
    const bool is_through =
        item.depth_mm > 5.0 && out_mm > view_trainer::kOutMm && !item.far_end_is_out;
    if (!is_through || out_mm < truth.wire_out_mm.value_or(0.0)) continue;
    const auto seen = fluoroscopy::project_point(posed.c_arm, {item.tip_in_patient});
    if (!seen) continue;
    truth.wire_out_mm = out_mm;
    truth.wire_shown_mm = bone.distance_at({seen->x, seen->y});
  }
  return truth;
}

protocol::ViewDebrief ViewDebrief::debrief(const simulation::Snapshot& end,
                                           std::span<const TakenShot> taken) {
  protocol::ViewDebrief message;
  message.revealed_mm = view_trainer::kRevealedMm;
  const auto screw = screw_in(data_, end);
  if (!screw) return message;
  message.screw = screw->instrument().name;
  const view_trainer::ScaphoidSurface& scaphoid = lying_at(end).scaphoid;
  const std::vector<Place> places = places_at(data_, end);
  const view_trainer::CaseViews presets(scaphoid, all_presets());
  struct Looked {
    const TakenShot* shot;
    PosedView posed;
    view_trainer::OutlineMap bone;
  };
  std::vector<Looked> looked;
  for (const TakenShot& shot : taken.last(std::min(taken.size(), kMostTaken))) {
    const auto then = screw_in(data_, shot.snapshot);
    if (!then || then->screw != screw->screw || length(then->tip - screw->tip) > kSamePlaceMm ||
        !are_alike(places_at(data_, shot.snapshot), places, data_.scaphoid.waist)) {
      continue;
    }
    PosedView posed = posed_of(data_, shot);
    view_trainer::OutlineMap bone = silhouette_of(scaphoid, posed);
    looked.push_back({&shot, std::move(posed), std::move(bone)});
  }
  const auto tell = [&](protocol::PlacementFault told, const auto& shown_mm) {
    const auto add = [&](protocol::FaultSeen seen, double mm) {
      seen.overhang_mm = mm;
      seen.reveals = mm >= view_trainer::kRevealedMm;
      told.seen.push_back(std::move(seen));
    };
    for (std::size_t i = 0; i < presets.views().size(); ++i) {
      const view_trainer::StandardView& view = presets.views()[i];
      protocol::FaultSeen seen;
      seen.view = view.id;
      seen.label = view.label;
      seen.rotation_deg = view.angles.rotation_deg;
      seen.tilt_deg = view.angles.tilt_deg;
      add(std::move(seen), shown_mm(presets.at(i).truth, presets.at(i).posed));
    }
    for (const Looked& one : looked) {
      protocol::FaultSeen seen;
      seen.tick = static_cast<std::int64_t>(one.shot->snapshot.tick);
      seen.shot = one.shot->number;
      seen.rotation_deg = simulation::held_rotation_deg(one.shot->rotation_deg,
                                                        one.shot->snapshot.wrist.pronation_rad);
      seen.tilt_deg = one.shot->tilt_deg;
      add(std::move(seen), shown_mm(one.bone, one.posed));
    }
    message.faults.push_back(std::move(told));
  };
  for (const view_trainer::PlacementFault& fault : faults_of(scaphoid, *screw)) {
    protocol::PlacementFault told;
    told.kind = protocol::FaultKind::ScrewOut;
    told.place = place_of(fault.region);
    told.depth_mm = fault.depth_mm;
    told.towards = fault.towards;
    tell(std::move(told), [&](const view_trainer::OutlineMap& bone, const PosedView& posed) {
      return overhang_of(fault, *screw, bone, posed);
    });
  }
  if (!faces_ || !lies_apart(faces_->offset(places[1]))) return message;
  const view_trainer::FractureFault fracture{
      faces_->first_normal,
      (places[1] * Point<frame::Bone>{faces_->second_middle}).v - faces_->first_middle};
  const auto tell_of_fracture = [&](protocol::FaultKind kind, double mm, auto shown_mm) {
    if (mm < view_trainer::kRevealedMm) return;
    protocol::PlacementFault told;
    told.kind = kind;
    told.place = protocol::ScrewPlace::Inside;
    told.depth_mm = mm;
    tell(std::move(told), [&](const view_trainer::OutlineMap&, const PosedView& posed) {
      return shown_mm(fracture, ray_of(posed, faces_->first_middle));
    });
  };
  tell_of_fracture(protocol::FaultKind::Gap, fracture.gap_mm(), view_trainer::clear_gap_mm);
  tell_of_fracture(protocol::FaultKind::Step, length(fracture.step()), view_trainer::seen_step_mm);
  return message;
}

}  // namespace carpus::server

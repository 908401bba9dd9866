// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fragments of a broken bone move against each other: pushed by what is driven into them, and
// turned and pulled by a joystick wire that a hand holds [clinical: B1 step 6]. They touch and do
// not enter each other, and stay where they are left.
#include <algorithm>
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::bit_of;
using detail::Displacement;
using detail::InBone;
using detail::Item;

namespace {

constexpr double kStiffnessNPerMm = 5.0;   // of a nonunion's gap tissue [E]
constexpr double kPushedMm = 2.0;          // by a push alone no farther [E]
constexpr double kYieldMmPerTick = 0.005;  // a fragment moves at most 5 mm a second
constexpr double kYieldRadPerTick = 0.0005;
constexpr double kPressedMm = 0.1;        // a tip this near its surface presses a fragment
constexpr double kSlackMm = 1.0;          // a hand's drift that a joystick does not pass on …
constexpr double kSlackRad = 0.03;        // … nor its turning
constexpr double kFirmMm = 1e-3;          // rounding of a corner that touched as scanned
constexpr double kFrictionOfFaces = 0.8;  // rough bone on rough bone [E]

/// A turn about `centre` that takes `from` to `to`, unit vectors, by at most `most_rad`.
InBone turn_about(const Vec3& centre, const Vec3& from, const Vec3& to, double most_rad) noexcept {
  const Vec3 axis = cross(from, to);
  const double sine = length(axis);
  if (!(sine > 0.0)) return {};
  // Half the angle, small: the quaternion (1, axis * half), normalised where it is used.
  const double half = 0.5 * std::min(sine, most_rad);
  const Vec3 turn = axis * (half / sine);
  const Mat3 rotation = rotation_from_quaternion(1.0, turn.x, turn.y, turn.z);
  return {rotation, centre - rotation * centre};
}

}  // namespace

procedure::FractureFacts World::State::fracture_now(const Model& model) const noexcept {
  if (!model.fracture) return {};
  const auto& [first, second, faces] = *model.fracture;
  return procedure::facts_of(faces.offset(inverses[first] * poses[second]));
}

/// Of an item's line in the target, from its entry to where it leaves it for good, the gap
/// included: of the fragments as they lie now.
double World::State::way_in_target_mm(const Model& model, const Item& item) const noexcept {
  constexpr double kStepMm = 0.1;
  constexpr double kLongestMm = 60.0;
  const Vec3 entry = entry_in_bone(item);
  bool has_moved = false;
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    const bool is_fragment = (model.kinds.target & model.kinds.fragments & bit_of(b)) != 0;
    has_moved = has_moved || (is_fragment && !now.moved[b].is_none());
  }
  if (!has_moved) return model.target.front().way_inside_mm(entry, item.direction_in_bone);
  double last_inside = 0.0;
  for (double at = 0.0; at < kLongestMm && at - last_inside < kBridgedGapMm; at += kStepMm) {
    const Vec3 p = (poses[item.body] * Point<frame::Bone>{entry + item.direction_in_bone * at}).v;
    for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
      if ((model.kinds.target & bit_of(b)) == 0) continue;
      const Vec3 local = (inverses[b] * Point<frame::Patient>{p}).v;
      if (tissue.is_near(b, local) && tissue.untouched_distance_mm(b, local) <= 0.0) {
        last_inside = at;
      }
    }
  }
  return last_inside;
}

/// Where the fragment, so displaced, would lie deeper in one of those bones than it may, told at
/// the corners of its hull, of which the deepest counts; nothing where it lies free.
std::optional<World::State::Blocked> World::State::blocked_by_another(
    const Model& model,
    std::uint8_t body,
    const Displacement& moved,
    detail::BodySet others) const noexcept {
  const detail::BodyPose pose = bases[body] * moved.pose();
  const Vec3 middle = (pose * Point<frame::Bone>{model.centres[body]}).v;
  double deepest = 0.0;
  std::optional<Blocked> blocked;
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    if (b == body || (others & bit_of(b)) == 0) continue;
    const bool is_fragment = (model.kinds.fragments & bit_of(b)) != 0;
    const Vec3 centre = (poses[b] * Point<frame::Bone>{model.centres[b]}).v;
    const double reach = model.reaches_mm[b];
    const double apart = reach + model.reaches_mm[body];
    if (squared_length(centre - middle) > apart * apart) continue;
    const auto depth_at = [&](const Vec3& local) noexcept {
      return tissue.is_near(b, local) ? -tissue.untouched_distance_mm(b, local) : 0.0;
    };
    for (const Vec3& corner : model.data.bones[body].hull.vertices) {
      const Vec3 at = (pose * Point<frame::Bone>{corner}).v;
      // With its back to another bone it cannot come into that.
      if (!is_fragment && dot(at - middle, centre - middle) <= 0.0) continue;
      if (squared_length(at - centre) > reach * reach) continue;
      const Vec3 local = (inverses[b] * Point<frame::Patient>{at}).v;
      const double depth = depth_at(local);
      if (!(depth > deepest)) continue;
      // Pieces fit as scanned; other bones have moved since, and are entered no deeper than now.
      const Vec3 before =
          is_fragment ? corner : (inverses[b] * (poses[body] * Point<frame::Bone>{corner})).v;
      const double allowed = std::max(0.0, depth_at(before));
      if (!(depth > allowed + kFirmMm)) continue;
      deepest = depth;
      const Vec3 out = (poses[b] * Direction<frame::Bone>{tissue.untouched_normal(b, local)}).v;
      blocked = Blocked{out, depth - allowed, is_fragment};
    }
  }
  return blocked;
}

/// Whether an instrument lies in this fragment and in another: it holds them together.
bool World::State::is_fragment_held(const Model& model, std::uint8_t body) const noexcept {
  const detail::BodySet others = model.kinds.fragments & ~bit_of(body);
  for (const Item& item : now.items) {
    if (!item.is_there() || !item.is_fixed()) continue;
    detail::BodySet entered = 0;
    for (std::size_t i = 0; i < item.crossing_count; ++i) {
      entered |= bit_of(item.crossings[i].body);
    }
    if ((entered & bit_of(body)) != 0 && (entered & others) != 0) return true;
  }
  return false;
}

/// Not farther from its place, in way or turn, than ligaments allow.
bool World::State::is_within_ligaments(const Model& model,
                                       std::uint8_t body,
                                       const Displacement& moved) const noexcept {
  const Vec3& centre = model.centres[body];
  const Vec3 way = (moved.pose() * Point<frame::Bone>{centre}).v - centre;
  return squared_length(way) <= detail::kGreatestShiftMm * detail::kGreatestShiftMm &&
         squared_length(moved.turn) <= detail::kGreatestTurn * detail::kGreatestTurn;
}

/// As far as it goes without entering one of those bones, along which it slides, and within what
/// ligaments allow. Fracture faces that are pressed onto each other hold by friction. It turns
/// where it has room for that, else it shifts alone.
void World::State::displace_fragment(const Model& model,
                                     std::uint8_t body,
                                     const InBone& by,
                                     detail::BodySet others) noexcept {
  constexpr int kSlides = 3;  // along one bone, two, then in the corner between three
  for (const bool is_turned : {true, false}) {
    if (!is_turned && by.rotation == Mat3::identity()) return;
    InBone step = is_turned ? by : InBone{Mat3::identity(), by.translation};
    for (int slide = 0; slide <= kSlides; ++slide) {
      const Displacement wanted = Displacement::of(step * now.moved[body].pose());
      if (!is_within_ligaments(model, body, wanted)) break;
      const std::optional<Blocked> blocked = blocked_by_another(model, body, wanted, others);
      if (!blocked) {
        now.moved[body] = wanted;
        return;
      }
      const Vec3 out = (bases[body].inverse() * Direction<frame::Patient>{blocked->out}).v;
      const double into = -dot(by.translation, out);
      const double along = length(by.translation + out * into);
      if (blocked->is_fragment && along <= kFrictionOfFaces * into) return;
      step.translation += out * blocked->excess_mm;
    }
  }
}

/// A fragment gives way along a push, against its gap tissue.
void World::State::push_fragment(const Model& model, const Item& item, double force_n) noexcept {
  bool has_moved = false;
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    if ((model.kinds.fragments & bit_of(b)) == 0) continue;
    // Pushed is the fragment in which the tip works; a line through both holds them together.
    const Vec3 tip = item.origin_in_bone + item.direction_in_bone * item.travel_mm;
    const Vec3 local =
        b == item.body ? tip : (inverses[b] * (poses[item.body] * Point<frame::Bone>{tip})).v;
    if (!tissue.is_near(b, local) || tissue.untouched_distance_mm(b, local) > kPressedMm) continue;
    if (item.body != b) break;
    const InBone moved = now.moved[b].pose();
    const Vec3 pushed = moved.rotation * item.direction_in_bone;
    const Vec3 gone = (moved * Point<frame::Bone>{model.centres[b]}).v - model.centres[b];
    // A joystick may have led it farther: a push never takes it back.
    const double on = std::min(kPushedMm, force_n / kStiffnessNPerMm) - dot(gone, pushed);
    if (!(on > 0.0)) continue;
    displace_fragment(model, b, {Mat3::identity(), pushed * std::min(on, kYieldMmPerTick)},
                      model.kinds.fragments);
    has_moved = true;
  }
  if (has_moved) pose_bodies(model);
}

/// A joystick wire in a fragment: the fragment follows where the hand takes it, turned about the
/// wire's tip and shifted, at a hand's slow speed.
void World::State::lead_fragment(const Model& model, std::uint8_t hand) noexcept {
  const Item& item = *in_hand(hand);
  const std::uint8_t body = item.body;
  if ((model.kinds.fragments & bit_of(body)) == 0 || is_fragment_held(model, body)) return;
  const HandInput& wish = spent.hands[hand].wish;
  const InBone back = now.moved[body].pose();
  const auto base_from_patient = bases[body].inverse();
  const Vec3 tip =
      (back * Point<frame::Bone>{item.origin_in_bone + item.direction_in_bone * item.travel_mm}).v;
  const Vec3 shaft = -(back * Direction<frame::Bone>{item.direction_in_bone}).v;
  const Vec3 wanted_tip = (base_from_patient * Point<frame::Patient>{wish.tip_in_patient}).v;
  const Vec3 wanted_shaft =
      (base_from_patient * Direction<frame::Patient>{wish.shaft_in_patient}).v;
  InBone by;
  const double turned = length(cross(shaft, wanted_shaft));
  if (turned > kSlackRad && dot(shaft, wanted_shaft) > 0.0) {
    by = turn_about(tip, shaft, wanted_shaft, std::min(kYieldRadPerTick, turned - kSlackRad));
  }
  const Vec3 way = wanted_tip - tip;
  const double far = length(way);
  if (far > kSlackMm) {
    by.translation += way * (std::min(kYieldMmPerTick, far - kSlackMm) / far);
  }
  if (by == InBone{}) return;
  constexpr detail::BodySet kAll = ~detail::BodySet{0};
  displace_fragment(model, body, by, kAll);
  pose_bodies(model);
  carry_fixed_items();
}

}  // namespace carpus::simulation
